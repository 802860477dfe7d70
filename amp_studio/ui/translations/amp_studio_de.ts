<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE">
    <context>
        <name />
        <message>
            <source>&amp;Name Axis…</source>
            <translation>Achse &amp;benennen…</translation>
        </message>
        <message>
            <source>Configure Axis &amp;Type…</source>
            <translation>Achs&amp;typ einstellen…</translation>
        </message>
        <message>
            <source>Configure &amp;Servo…</source>
            <translation>&amp;Servo einstellen…</translation>
        </message>
        <message>
            <source>&amp;Add Axis…</source>
            <translation>Achse &amp;hinzufügen…</translation>
        </message>
        <message>
            <source>&amp;Delete Axis…</source>
            <translation>Achse &amp;löschen…</translation>
        </message>
        <message>
            <source>&amp;Copy Axis…</source>
            <translation>Achse &amp;kopieren…</translation>
        </message>
        <message>
            <source>S&amp;wap Axes…</source>
            <translation>Achsen ta&amp;uschen…</translation>
        </message>
        <message>
            <source>Com&amp;pare Axes…</source>
            <translation>Achsen &amp;vergleichen…</translation>
        </message>
        <message>
            <source>Notes</source>
            <translation>Notizen</translation>
        </message>
        <message>
            <source>&amp;File</source>
            <translation>&amp;Datei</translation>
        </message>
        <message>
            <source>&amp;New…</source>
            <translation>&amp;Neu…</translation>
        </message>
        <message>
            <source>New</source>
            <translation>Neu</translation>
        </message>
        <message>
            <source>&amp;Open…</source>
            <translation>Ö&amp;ffnen…</translation>
        </message>
        <message>
            <source>&amp;Save</source>
            <translation>&amp;Speichern</translation>
        </message>
        <message>
            <source>Save &amp;As…</source>
            <translation>Speichern &amp;unter…</translation>
        </message>
        <message>
            <source>&amp;Close</source>
            <translation>Sch&amp;ließen</translation>
        </message>
        <message>
            <source>Compare and Merge &amp;With…</source>
            <translation>Vergleichen und &amp;zusammenführen mit…</translation>
        </message>
        <message>
            <source>Compare</source>
            <translation>Vergleichen</translation>
        </message>
        <message>
            <source>Recover &amp;Backup…</source>
            <translation>Si&amp;cherung zurückholen…</translation>
        </message>
        <message>
            <source>&amp;Import…</source>
            <translation>&amp;Importieren…</translation>
        </message>
        <message>
            <source>Ex&amp;port…</source>
            <translation>Expo&amp;rtieren…</translation>
        </message>
        <message>
            <source>&amp;Report…</source>
            <translation>&amp;Bericht…</translation>
        </message>
        <message>
            <source>&amp;Form to Fill In…</source>
            <translation>F&amp;ormular zum Ausfüllen…</translation>
        </message>
        <message>
            <source>New Report &amp;Template…</source>
            <translation>Neue Berichts&amp;vorlage…</translation>
        </message>
        <message>
            <source>&amp;Machine Facts…</source>
            <translation>An&amp;gaben zur Maschine…</translation>
        </message>
        <message>
            <source>E&amp;xit</source>
            <translation>Been&amp;den</translation>
        </message>
        <message>
            <source>&amp;Edit</source>
            <translation>&amp;Bearbeiten</translation>
        </message>
        <message>
            <source>Undo</source>
            <translation>Zurücknehmen</translation>
        </message>
        <message>
            <source>Redo</source>
            <translation>Wiederholen</translation>
        </message>
        <message>
            <source>Histor&amp;y of Steps…</source>
            <translation>Verlauf der Sc&amp;hritte…</translation>
        </message>
        <message>
            <source>&amp;Edit Value</source>
            <translation>Wert &amp;bearbeiten</translation>
        </message>
        <message>
            <source>N&amp;ote…</source>
            <translation>N&amp;otiz…</translation>
        </message>
        <message>
            <source>&amp;Quick Edit by Number…</source>
            <translation>Schnell nach &amp;Nummer…</translation>
        </message>
        <message>
            <source>Ca&amp;lculator…</source>
            <translation>&amp;Rechner…</translation>
        </message>
        <message>
            <source>&amp;Tables of the Manual…</source>
            <translation>Tabellen &amp;des Handbuchs…</translation>
        </message>
        <message>
            <source>F&amp;ix Selected Finding</source>
            <translation>Befund &amp;jetzt beheben</translation>
        </message>
        <message>
            <source>Fix Se&amp;veral…</source>
            <translation>&amp;Probleme beheben…</translation>
        </message>
        <message>
            <source>Apply All &amp;Safe Fixes</source>
            <translation>Alle &amp;sicheren Korrekturen</translation>
        </message>
        <message>
            <source>S&amp;how Explanation of Finding</source>
            <translation>Befund erkl&amp;ären</translation>
        </message>
        <message>
            <source>&amp;Find…</source>
            <translation>&amp;Finden…</translation>
        </message>
        <message>
            <source>&amp;Go to Number…</source>
            <translation>&amp;Gehe zu Nummer…</translation>
        </message>
        <message>
            <source>&amp;Copy</source>
            <translation>&amp;Kopieren</translation>
        </message>
        <message>
            <source>Copy with Na&amp;mes</source>
            <translation>Mit Na&amp;men kopieren</translation>
        </message>
        <message>
            <source>&amp;Paste…</source>
            <translation>&amp;Einfügen…</translation>
        </message>
        <message>
            <source>Fill &amp;Down</source>
            <translation>Nach &amp;unten füllen</translation>
        </message>
        <message>
            <source>Fill &amp;Across Axes</source>
            <translation>Über die &amp;Achsen füllen</translation>
        </message>
        <message>
            <source>&amp;Back to Default</source>
            <translation>Zurück zur &amp;Vorgabe</translation>
        </message>
        <message>
            <source>Clear (&amp;Not Set)</source>
            <translation>&amp;Leeren (nicht gesetzt)</translation>
        </message>
        <message>
            <source>Copy to All A&amp;xes of the Type</source>
            <translation>Auf alle Achsen des &amp;Typs kopieren</translation>
        </message>
        <message>
            <source>&amp;Axis</source>
            <translation>&amp;Achse</translation>
        </message>
        <message>
            <source>&amp;Units</source>
            <translation>&amp;Einheiten</translation>
        </message>
        <message>
            <source>Control &amp;Type</source>
            <translation>&amp;Steuerungstyp</translation>
        </message>
        <message>
            <source>S&amp;witch mm / inch</source>
            <translation>mm / &amp;Zoll wechseln</translation>
        </message>
        <message>
            <source>mm / inch</source>
            <translation>mm / Zoll</translation>
        </message>
        <message>
            <source>Show Values &amp;As Entered</source>
            <translation>Werte &amp;wie eingegeben</translation>
        </message>
        <message>
            <source>Show Un&amp;fitted Axes</source>
            <translation>Nicht &amp;vorhandene Achsen zeigen</translation>
        </message>
        <message>
            <source>Show &amp;Hidden Parameters</source>
            <translation>Verborgene P&amp;arameter zeigen</translation>
        </message>
        <message>
            <source>Show Se&amp;crets</source>
            <translation>Gehei&amp;mes zeigen</translation>
        </message>
        <message>
            <source>Show passwords in clear text, also in exports</source>
            <translation>Passwörter im Klartext zeigen, auch in Exporten</translation>
        </message>
        <message>
            <source>Ne&amp;xt File</source>
            <translation>&amp;Nächste Datei</translation>
        </message>
        <message>
            <source>Pre&amp;vious File</source>
            <translation>V&amp;orige Datei</translation>
        </message>
        <message>
            <source>Show File &amp;Beside</source>
            <translation>Datei &amp;daneben zeigen</translation>
        </message>
        <message>
            <source>&amp;Motion…</source>
            <translation>Bewe&amp;gung…</translation>
        </message>
        <message>
            <source>Motion</source>
            <translation>Bewegung</translation>
        </message>
        <message>
            <source>&amp;Pictures</source>
            <translation>&amp;Bilder</translation>
        </message>
        <message>
            <source>Pictures</source>
            <translation>Bilder</translation>
        </message>
        <message>
            <source>Save P&amp;icture As SVG…</source>
            <translation>B&amp;ild als SVG speichern…</translation>
        </message>
        <message>
            <source>Rep&amp;ort Preview</source>
            <translation>Berich&amp;tsvorschau</translation>
        </message>
        <message>
            <source>Preview</source>
            <translation>Vorschau</translation>
        </message>
        <message>
            <source>Filte&amp;r</source>
            <translation>&amp;Filter</translation>
        </message>
        <message>
            <source>Th&amp;eme</source>
            <translation>Fa&amp;rben</translation>
        </message>
        <message>
            <source>La&amp;nguage</source>
            <translation>S&amp;prache</translation>
        </message>
        <message>
            <source>&amp;Go To</source>
            <translation>Ge&amp;he zu</translation>
        </message>
        <message>
            <source>&amp;Table</source>
            <translation>&amp;Tabelle</translation>
        </message>
        <message>
            <source>&amp;Groups</source>
            <translation>&amp;Gruppen</translation>
        </message>
        <message>
            <source>&amp;Parameter Help</source>
            <translation>&amp;Parameterhilfe</translation>
        </message>
        <message>
            <source>&amp;Findings</source>
            <translation>&amp;Befunde</translation>
        </message>
        <message>
            <source>&amp;Next Finding</source>
            <translation>&amp;Nächster Befund</translation>
        </message>
        <message>
            <source>Pre&amp;vious Finding</source>
            <translation>&amp;Voriger Befund</translation>
        </message>
        <message>
            <source>&amp;Reset Layout</source>
            <translation>&amp;Anordnung zurücksetzen</translation>
        </message>
        <message>
            <source>&amp;Control</source>
            <translation>&amp;Steuerung</translation>
        </message>
        <message>
            <source>&amp;At the Control</source>
            <translation>An der Ste&amp;uerung</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>Sen&amp;d to the Control…</source>
            <translation>An Steuerung &amp;senden…</translation>
        </message>
        <message>
            <source>&amp;Compare With the Control…</source>
            <translation>Mit der Steuerung &amp;vergleichen…</translation>
        </message>
        <message>
            <source>Read &amp;From the Control…</source>
            <translation>Aus der Steuerung aus&amp;lesen…</translation>
        </message>
        <message>
            <source>&amp;Restore Control From Backup…</source>
            <translation>Steuerung aus Sicherung &amp;wiederherstellen…</translation>
        </message>
        <message>
            <source>Enter Values by &amp;Hand…</source>
            <translation>Werte von Hand &amp;eingeben…</translation>
        </message>
        <message>
            <source>Se&amp;veral Controls…</source>
            <translation>&amp;Mehrere Steuerungen…</translation>
        </message>
        <message>
            <source>E&amp;xchanges of This File…</source>
            <translation>Aus&amp;tausch dieser Datei…</translation>
        </message>
        <message>
            <source>&amp;Live…</source>
            <translation>L&amp;ive…</translation>
        </message>
        <message>
            <source>Chec&amp;k in Motion…</source>
            <translation>Bewegung p&amp;rüfen…</translation>
        </message>
        <message>
            <source>&amp;Tuning…</source>
            <translation>&amp;Abgleich…</translation>
        </message>
        <message>
            <source>&amp;Start Emulated Control</source>
            <translation>Nach&amp;gebildete Steuerung starten</translation>
        </message>
        <message>
            <source>Emulated Control in &amp;E-Stop</source>
            <translation>Nachgebildete Steuerung im &amp;Not-Halt</translation>
        </message>
        <message>
            <source>Sto&amp;p Emulated Control</source>
            <translation>Nachgebildete Steuerung been&amp;den</translation>
        </message>
        <message>
            <source>&amp;Project</source>
            <translation>&amp;Projekt</translation>
        </message>
        <message>
            <source>&amp;New Project…</source>
            <translation>&amp;Neues Projekt…</translation>
        </message>
        <message>
            <source>&amp;Open Project…</source>
            <translation>Projekt ö&amp;ffnen…</translation>
        </message>
        <message>
            <source>Project &amp;Information…</source>
            <translation>An&amp;gaben zum Projekt…</translation>
        </message>
        <message>
            <source>Open &amp;File of the Project…</source>
            <translation>&amp;Datei des Projekts öffnen…</translation>
        </message>
        <message>
            <source>Chec&amp;k All Files…</source>
            <translation>Alle Dateien p&amp;rüfen…</translation>
        </message>
        <message>
            <source>Compare &amp;Machines…</source>
            <translation>Maschinen &amp;vergleichen…</translation>
        </message>
        <message>
            <source>&amp;Copy File…</source>
            <translation>Datei &amp;kopieren…</translation>
        </message>
        <message>
            <source>Copy from &amp;Another Project…</source>
            <translation>Aus einem &amp;anderen Projekt kopieren…</translation>
        </message>
        <message>
            <source>&amp;Rename File…</source>
            <translation>Datei &amp;umbenennen…</translation>
        </message>
        <message>
            <source>&amp;Delete File…</source>
            <translation>Datei &amp;löschen…</translation>
        </message>
        <message>
            <source>Reco&amp;ver a Deleted or Older File…</source>
            <translation>Gelöschte oder &amp;ältere Datei zurückholen…</translation>
        </message>
        <message>
            <source>&amp;Help</source>
            <translation>&amp;Hilfe</translation>
        </message>
        <message>
            <source>&amp;Commands…</source>
            <translation>Be&amp;fehle…</translation>
        </message>
        <message>
            <source>&amp;About AMP Studio</source>
            <translation>Ü&amp;ber AMP Studio</translation>
        </message>
        <message>
            <source>With findings</source>
            <translation>Mit Befunden</translation>
        </message>
        <message>
            <source>&amp;All Rows</source>
            <translation>&amp;Alle Zeilen</translation>
        </message>
        <message>
            <source>Boo&amp;kmark</source>
            <translation>Lesezei&amp;chen</translation>
        </message>
        <message>
            <source>Reading the last download</source>
            <translation>Die letzte Sendung wird gelesen</translation>
        </message>
        <message>
            <source>Select a value in the table first.</source>
            <translation>Erst einen Wert in der Tabelle auswählen.</translation>
        </message>
        <message>
            <source>{name} is bookmarked.</source>
            <translation>{name} hat ein Lesezeichen.</translation>
        </message>
        <message>
            <source>{name} is no longer bookmarked.</source>
            <translation>{name} hat kein Lesezeichen mehr.</translation>
        </message>
        <message>
            <source>No.</source>
            <translation>Nr.</translation>
        </message>
        <message>
            <source>Report Preview</source>
            <translation>Berichtsvorschau</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>{name} is secret. To copy it, first switch on Show Secrets.</source>
            <translation>{name} ist geheim. Zum Kopieren erst „Geheimes zeigen“ einschalten.</translation>
        </message>
        <message>
            <source>Secrets are left out; Show Secrets takes them along.</source>
            <translation>Geheimes wird ausgelassen; „Geheimes zeigen“ nimmt es mit.</translation>
        </message>
        <message>
            <source>There is no text to paste.</source>
            <translation>Es gibt keinen Text zum Einfügen.</translation>
        </message>
        <message>
            <source>1 cell is beyond the table.</source>
            <translation>1 Zelle liegt außerhalb der Tabelle.</translation>
        </message>
        <message numerus="yes">
            <source>%n cells are beyond the table.</source>
            <translation>
                <numerusform>%n Zelle liegt außerhalb der Tabelle.</numerusform>
                <numerusform>%n Zellen liegen außerhalb der Tabelle.</numerusform>
            </translation>
        </message>
        <message>
            <source>{name} is not in this list.</source>
            <translation>{name} ist nicht in dieser Liste.</translation>
        </message>
        <message>
            <source>There is no column {head}.</source>
            <translation>Es gibt keine Spalte {head}.</translation>
        </message>
        <message>
            <source>Select the cell with the value and those to fill.</source>
            <translation>Die Zelle mit dem Wert und die zu füllenden auswählen.</translation>
        </message>
        <message>
            <source>{name} is secret.</source>
            <translation>{name} ist geheim.</translation>
        </message>
        <message numerus="yes">
            <source>and %n more</source>
            <translation>
                <numerusform>und %n weitere</numerusform>
                <numerusform>und %n weitere</numerusform>
            </translation>
        </message>
        <message>
            <source>Nothing was changed. {reasons}.</source>
            <translation>Nichts wurde geändert. {reasons}.</translation>
        </message>
        <message>
            <source>No default is printed for {name}. Press Delete to clear the value.</source>
            <translation>Für {name} ist keine Vorgabe gedruckt. Entf leert den Wert.</translation>
        </message>
        <message numerus="yes">
            <source>%n values have no printed default and are as before.</source>
            <translation>
                <numerusform>%n Wert hat keine gedruckte Vorgabe und bleibt wie er war.</numerusform>
                <numerusform>%n Werte haben keine gedruckte Vorgabe und bleiben wie sie waren.</numerusform>
            </translation>
        </message>
        <message>
            <source>Select a value of a fitted axis first.</source>
            <translation>Erst einen Wert einer vorhandenen Achse auswählen.</translation>
        </message>
        <message>
            <source>Does not exist here: {why}</source>
            <translation>Gibt es hier nicht: {why}</translation>
        </message>
        <message>
            <source>Effective value in the control: {value}</source>
            <translation>Wirksamer Wert in der Steuerung: {value}</translation>
        </message>
        <message>
            <source>Forced {when}</source>
            <translation>Erzwungen {when}</translation>
        </message>
        <message>
            <source>Note: {text}</source>
            <translation>Notiz: {text}</translation>
        </message>
        <message>
            <source>Saved: {value}</source>
            <translation>Gespeichert: {value}</translation>
        </message>
        <message>
            <source>Entered as {value}</source>
            <translation>Eingegeben als {value}</translation>
        </message>
        <message>
            <source>PDF (*.pdf);;Web page (*.html);;Text (*.txt)</source>
            <translation>PDF (*.pdf);;Webseite (*.html);;Text (*.txt)</translation>
        </message>
        <message>
            <source>Check List</source>
            <translation>Checkliste</translation>
        </message>
        <message>
            <source>Form to Fill In</source>
            <translation>Formular zum Ausfüllen</translation>
        </message>
        <message>
            <source>{path} written</source>
            <translation>{path} geschrieben</translation>
        </message>
        <message>
            <source>New Report Template</source>
            <translation>Neue Berichtsvorlage</translation>
        </message>
        <message>
            <source>About AMP Studio</source>
            <translation>Über AMP Studio</translation>
        </message>
        <message>
            <source>AMP Studio {version}

The numbered parameters of machine controls: edit, check, print, exchange and simulate them.</source>
            <translation>AMP Studio {version}

Die nummerierten Parameter von Maschinensteuerungen: bearbeiten, prüfen, drucken, austauschen und simulieren.</translation>
        </message>
        <message>
            <source>Not set</source>
            <translation>Nicht gesetzt</translation>
        </message>
        <message>
            <source>Active values that are not set</source>
            <translation>Aktive Werte, die nicht gesetzt sind</translation>
        </message>
        <message>
            <source>Changed</source>
            <translation>Geändert</translation>
        </message>
        <message>
            <source>Values that are not the printed default</source>
            <translation>Werte, die nicht die gedruckte Vorgabe sind</translation>
        </message>
        <message>
            <source>Findings</source>
            <translation>Befunde</translation>
        </message>
        <message>
            <source>Values that cause a finding</source>
            <translation>Werte, die einen Befund verursachen</translation>
        </message>
        <message>
            <source>Axes differ</source>
            <translation>Achsen verschieden</translation>
        </message>
        <message>
            <source>Parameters whose axes have different values</source>
            <translation>Parameter, deren Achsen verschiedene Werte haben</translation>
        </message>
        <message>
            <source>Not saved</source>
            <translation>Nicht gespeichert</translation>
        </message>
        <message>
            <source>Values that are not as on disk</source>
            <translation>Werte, die nicht wie auf der Platte sind</translation>
        </message>
        <message>
            <source>Changed since download</source>
            <translation>Seit dem Senden geändert</translation>
        </message>
        <message>
            <source>Values that are not as in the last recorded download</source>
            <translation>Werte, die nicht wie bei der letzten aufgezeichneten Sendung sind</translation>
        </message>
        <message>
            <source>Active after restart</source>
            <translation>Wirkt nach Neustart</translation>
        </message>
        <message>
            <source>Values that take effect after a restart</source>
            <translation>Werte, die nach einem Neustart wirken</translation>
        </message>
        <message>
            <source>Recently edited</source>
            <translation>Zuletzt bearbeitet</translation>
        </message>
        <message>
            <source>The last values that were edited here</source>
            <translation>Die hier zuletzt bearbeiteten Werte</translation>
        </message>
        <message>
            <source>Bookmarked</source>
            <translation>Mit Lesezeichen</translation>
        </message>
        <message>
            <source>Parameters that you have bookmarked (Ctrl+B)</source>
            <translation>Parameter mit Lesezeichen (Strg+B)</translation>
        </message>
        <message>
            <source>With a note</source>
            <translation>Mit Notiz</translation>
        </message>
        <message>
            <source>Values with a note</source>
            <translation>Werte mit einer Notiz</translation>
        </message>
        <message>
            <source>Parameters</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>Values</source>
            <translation>Werte</translation>
        </message>
        <message>
            <source>Choices</source>
            <translation>Auswahlen</translation>
        </message>
        <message>
            <source>Messages of the control</source>
            <translation>Meldungen der Steuerung</translation>
        </message>
        <message>
            <source>Groups</source>
            <translation>Gruppen</translation>
        </message>
        <message>
            <source>Commands</source>
            <translation>Befehle</translation>
        </message>
        <message>
            <source>&amp;Next Not Set</source>
            <translation>&amp;Nächster offener Wert</translation>
        </message>
        <message>
            <source>Mark Step as &amp;Done</source>
            <translation>Schritt ist &amp;erledigt</translation>
        </message>
        <message>
            <source>Keep De&amp;faults of This Step</source>
            <translation>&amp;Vorgaben dieses Schritts behalten</translation>
        </message>
        <message>
            <source>&amp;Show Later Findings</source>
            <translation>&amp;Spätere Befunde zeigen</translation>
        </message>
        <message>
            <source>&amp;Check List…</source>
            <translation>&amp;Checkliste…</translation>
        </message>
        <message>
            <source>&amp;Guide</source>
            <translation>&amp;Leitfaden</translation>
        </message>
        <message>
            <source>Every active value is set.</source>
            <translation>Jeder aktive Wert ist gesetzt.</translation>
        </message>
        <message>
            <source>All at their defaults, check them too: {steps}</source>
            <translation>Alle auf ihren Vorgaben, auch prüfen: {steps}</translation>
        </message>
        <message>
            <source>{now} by {user}</source>
            <translation>{now} von {user}</translation>
        </message>
        <message>
            <source>Step {number} not done</source>
            <translation>Schritt {number} nicht erledigt</translation>
        </message>
        <message>
            <source>Step {number} done</source>
            <translation>Schritt {number} erledigt</translation>
        </message>
        <message>
            <source>{title} is ticked. Left: {open} values not set, {errors} errors.</source>
            <translation>{title} ist abgehakt. Übrig: {open} Werte nicht gesetzt, {errors} Fehler.</translation>
        </message>
        <message>
            <source>The manual prints no default for any open value of this step.</source>
            <translation>Das Handbuch druckt für keinen offenen Wert dieses Schritts eine Vorgabe.</translation>
        </message>
        <message>
            <source>Keep defaults</source>
            <translation>Vorgaben behalten</translation>
        </message>
        <message>
            <source>Compare with</source>
            <translation>Vergleichen mit</translation>
        </message>
        <message>
            <source>Other Files</source>
            <translation>Andere Dateien</translation>
        </message>
        <message>
            <source>Another &amp;File…</source>
            <translation>Andere &amp;Datei…</translation>
        </message>
        <message>
            <source>&amp;Save {file}</source>
            <translation>{file} &amp;speichern</translation>
        </message>
        <message>
            <source>Ours</source>
            <translation>Unsere</translation>
        </message>
        <message>
            <source>Theirs</source>
            <translation>Ihre</translation>
        </message>
        <message>
            <source>Base</source>
            <translation>Basis</translation>
        </message>
        <message>
            <source>goes to {file}</source>
            <translation>geht nach {file}</translation>
        </message>
        <message>
            <source>Report of the comparison</source>
            <translation>Bericht des Vergleichs</translation>
        </message>
        <message>
            <source>{file} written.</source>
            <translation>{file} geschrieben.</translation>
        </message>
        <message>
            <source>at once</source>
            <translation>sofort</translation>
        </message>
        <message>
            <source>on reset</source>
            <translation>nach einem Reset</translation>
        </message>
        <message>
            <source>on restart</source>
            <translation>nach einem Neustart</translation>
        </message>
        <message>
            <source>on restart, at once with {command} at the control</source>
            <translation>nach einem Neustart, sofort mit {command} an der Steuerung</translation>
        </message>
        <message>
            <source>on {command}</source>
            <translation>nach {command}</translation>
        </message>
        <message>
            <source>not in the manual</source>
            <translation>nicht im Handbuch</translation>
        </message>
        <message>
            <source>&amp;View</source>
            <translation>Ansich&amp;t</translation>
        </message>
        <message>
            <source>Saving the control's present parameters …</source>
            <translation>Die jetzigen Parameter der Steuerung werden gesichert …</translation>
        </message>
        <message>
            <source>Sending the file …</source>
            <translation>Die Datei wird gesendet …</translation>
        </message>
        <message>
            <source>The control is checking and storing the parameters …</source>
            <translation>Die Steuerung prüft und speichert die Parameter …</translation>
        </message>
        <message>
            <source>Waiting for the control to restart …</source>
            <translation>Wartet auf den Neustart der Steuerung …</translation>
        </message>
        <message>
            <source>Reading all parameters back and comparing …</source>
            <translation>Alle Parameter werden zurückgelesen und verglichen …</translation>
        </message>
        <message>
            <source>Reading the parameters of the control …</source>
            <translation>Die Parameter der Steuerung werden gelesen …</translation>
        </message>
        <message>
            <source>Waiting for the control …</source>
            <translation>Wartet auf die Steuerung …</translation>
        </message>
        <message>
            <source>Opening</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>not connected</source>
            <translation>nicht verbunden</translation>
        </message>
        <message>
            <source>needs a password</source>
            <translation>braucht ein Passwort</translation>
        </message>
        <message>
            <source>not in E-stop</source>
            <translation>nicht im Not-Halt</translation>
        </message>
        <message>
            <source>connection lost</source>
            <translation>Verbindung verloren</translation>
        </message>
        <message>
            <source>connecting</source>
            <translation>verbindet</translation>
        </message>
        <message>
            <source>ready</source>
            <translation>bereit</translation>
        </message>
        <message>
            <source>sending</source>
            <translation>sendet</translation>
        </message>
        <message>
            <source>did not reach its end</source>
            <translation>nicht zu Ende geführt</translation>
        </message>
        <message>
            <source>{name} has errors, and there is no control image beside it. First error: {message}</source>
            <translation>{name} hat Fehler, und daneben liegt kein Abbild einer Steuerung. Erster Fehler: {message}</translation>
        </message>
        <message>
            <source>Choose a control at the left, or take a file.</source>
            <translation>Links eine Steuerung wählen, oder eine Datei nehmen.</translation>
        </message>
        <message>
            <source>The control contains no parameters.</source>
            <translation>Die Steuerung enthält keine Parameter.</translation>
        </message>
        <message>
            <source>What the control contains</source>
            <translation>Was die Steuerung enthält</translation>
        </message>
        <message>
            <source>{name} cannot be read: {why}.</source>
            <translation>{name} ist nicht lesbar: {why}.</translation>
        </message>
        <message>
            <source>Step</source>
            <translation>Schritt</translation>
        </message>
        <message>
            <source>Number</source>
            <translation>Nummer</translation>
        </message>
        <message>
            <source>Key In</source>
            <translation>Eingeben</translation>
        </message>
        <message>
            <source>Unit</source>
            <translation>Einheit</translation>
        </message>
        <message>
            <source>Now</source>
            <translation>Jetzt</translation>
        </message>
        <message>
            <source>Screen Shows</source>
            <translation>Schirm zeigt</translation>
        </message>
        <message>
            <source>Result</source>
            <translation>Ergebnis</translation>
        </message>
        <message>
            <source>today {time}</source>
            <translation>heute {time}</translation>
        </message>
        <message>
            <source>yesterday {time}</source>
            <translation>gestern {time}</translation>
        </message>
        <message>
            <source>en</source>
            <comment>language of the names of months</comment>
            <translation>de</translation>
        </message>
        <message>
            <source>Report</source>
            <translation>Bericht</translation>
        </message>
        <message>
            <source>Writing {name} …</source>
            <translation>{name} wird geschrieben …</translation>
        </message>
        <message>
            <source>Setting the pages …</source>
            <translation>Die Seiten werden gesetzt …</translation>
        </message>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source>Danger</source>
            <translation>Gefahr</translation>
        </message>
        <message>
            <source>Warning</source>
            <translation>Warnung</translation>
        </message>
        <message>
            <source>Note</source>
            <translation>Notiz</translation>
        </message>
        <message>
            <source>Allowed here:</source>
            <translation>Hier erlaubt:</translation>
        </message>
        <message>
            <source>As delivered:</source>
            <translation>Wie ausgeliefert:</translation>
        </message>
        <message>
            <source>Calculate…</source>
            <translation>Berechnen…</translation>
        </message>
        <message>
            <source>Cause:</source>
            <translation>Ursache:</translation>
        </message>
        <message numerus="yes">
            <source>Conflicts left: %n</source>
            <translation>
                <numerusform>Noch %n Konflikt</numerusform>
                <numerusform>Noch %n Konflikte</numerusform>
            </translation>
        </message>
        <message>
            <source>Cure:</source>
            <translation>Abhilfe:</translation>
        </message>
        <message>
            <source>Facts</source>
            <translation>Fakten</translation>
        </message>
        <message>
            <source>Formulas</source>
            <translation>Formeln</translation>
        </message>
        <message>
            <source>No rule uses this parameter.</source>
            <translation>Keine Regel liest diesen Parameter.</translation>
        </message>
        <message>
            <source>No saved changes of {name} yet.</source>
            <translation>Noch keine gespeicherten Änderungen von {name}.</translation>
        </message>
        <message>
            <source>Page {pages}</source>
            <translation>Seite {pages}</translation>
        </message>
        <message>
            <source>Parameters:</source>
            <translation>Parameter:</translation>
        </message>
        <message>
            <source>Show all</source>
            <translation>Alle zeigen</translation>
        </message>
        <message>
            <source>Show them</source>
            <translation>Anzeigen</translation>
        </message>
        <message>
            <source>Show</source>
            <translation>Zeigen</translation>
        </message>
        <message>
            <source>The manual does not print the text of this message.</source>
            <translation>Das Handbuch druckt den Text dieser Meldung nicht.</translation>
        </message>
        <message>
            <source>Use</source>
            <translation>Übernehmen</translation>
        </message>
        <message>
            <source>as stored in the control</source>
            <translation>wie in der Steuerung gespeichert</translation>
        </message>
        <message>
            <source>effective value in the control</source>
            <translation>wirksamer Wert in der Steuerung</translation>
        </message>
        <message>
            <source>empty:</source>
            <translation>leer:</translation>
        </message>
        <message>
            <source>no control chosen</source>
            <translation>keine Steuerung gewählt</translation>
        </message>
        <message>
            <source>none in this file</source>
            <translation>keine in dieser Datei</translation>
        </message>
        <message>
            <source>page {page}</source>
            <translation>Seite {page}</translation>
        </message>
        <message>
            <source>page</source>
            <translation>Seite</translation>
        </message>
        <message>
            <source>taken</source>
            <translation>übernommen</translation>
        </message>
        <message>
            <source>.</source>
            <comment>decimal sign</comment>
            <translation>,</translation>
        </message>
        <message>
            <source>Same machine</source>
            <translation>Dieselbe Maschine</translation>
        </message>
        <message>
            <source>E-stop</source>
            <translation>Not-Halt</translation>
        </message>
        <message>
            <source>Password</source>
            <translation>Passwort</translation>
        </message>
        <message>
            <source>Connected</source>
            <translation>Verbunden</translation>
        </message>
        <message>
            <source>Needs a password</source>
            <translation>Braucht ein Passwort</translation>
        </message>
        <message>
            <source>Not connected</source>
            <translation>Nicht verbunden</translation>
        </message>
        <message>
            <source>No E-stop needed</source>
            <translation>Kein Not-Halt nötig</translation>
        </message>
        <message>
            <source>E-stop is pressed</source>
            <translation>Not-Halt ist gedrückt</translation>
        </message>
        <message>
            <source>E-stop is not pressed</source>
            <translation>Not-Halt ist aus</translation>
        </message>
        <message>
            <source>Password accepted</source>
            <translation>Passwort angenommen</translation>
        </message>
        <message>
            <source>No password needed</source>
            <translation>Kein Passwort nötig</translation>
        </message>
        <message>
            <source>A write lasts in {states}</source>
            <translation>Geschriebenes bleibt in {states}</translation>
        </message>
        <message>
            <source>Another family: {name}</source>
            <translation>Andere Familie: {name}</translation>
        </message>
        <message>
            <source>Numbers its parameters by another schema</source>
            <translation>Nummeriert seine Parameter nach einem anderen Schema</translation>
        </message>
        <message>
            <source>asked {seconds} s ago</source>
            <translation>gefragt vor {seconds} s</translation>
        </message>
        <message>
            <source>asked now</source>
            <translation>eben gefragt</translation>
        </message>
        <message>
            <source>{done} of {total}</source>
            <translation>{done} von {total}</translation>
        </message>
        <message>
            <source>Commit all or nothing</source>
            <translation>Alles oder nichts übernehmen</translation>
        </message>
        <message>
            <source>until then the old values stay</source>
            <translation>bis dahin gelten die alten Werte</translation>
        </message>
        <message>
            <source>Each value acts at once</source>
            <translation>Jeder Wert wirkt sofort</translation>
        </message>
        <message>
            <source>cancelling leaves what is confirmed</source>
            <translation>ein Abbruch lässt, was bestätigt ist</translation>
        </message>
        <message>
            <source>Identify</source>
            <translation>Erkennen</translation>
        </message>
        <message>
            <source>same machine, same options</source>
            <translation>dieselbe Maschine, dieselben Optionen</translation>
        </message>
        <message>
            <source>Back up what it contains</source>
            <translation>Inhalt sichern</translation>
        </message>
        <message>
            <source>as a file beside this one</source>
            <translation>als Datei neben dieser</translation>
        </message>
        <message numerus="yes">
            <source>Write %n values</source>
            <translation>
                <numerusform>%n Wert schreiben</numerusform>
                <numerusform>%n Werte schreiben</numerusform>
            </translation>
        </message>
        <message>
            <source>only what was shown may be replaced</source>
            <translation>ersetzt wird nur, was gezeigt wurde</translation>
        </message>
        <message>
            <source>Read everything back</source>
            <translation>Alles zurücklesen</translation>
        </message>
        <message>
            <source>compared exactly</source>
            <translation>genau verglichen</translation>
        </message>
        <message>
            <source>reads only</source>
            <translation>liest nur</translation>
        </message>
        <message>
            <source>Read what it contains</source>
            <translation>Inhalt auslesen</translation>
        </message>
        <message>
            <source>nothing is changed in the control</source>
            <translation>in der Steuerung ändert sich nichts</translation>
        </message>
        <message>
            <source>Compare with the file</source>
            <translation>Mit der Datei vergleichen</translation>
        </message>
        <message>
            <source>every value, exactly</source>
            <translation>jeden Wert, genau</translation>
        </message>
        <message>
            <source>{letter} axis</source>
            <translation>{letter}-Achse</translation>
        </message>
        <message>
            <source>{family} has no parameter for the servo of an axis</source>
            <translation>{family} hat keinen Parameter für den Servo einer Achse</translation>
        </message>
        <message>
            <source>All {count} axes are there</source>
            <translation>Alle {count} Achsen sind da</translation>
        </message>
        <message>
            <source>{family} has one axis at most</source>
            <translation>{family} hat höchstens eine Achse</translation>
        </message>
        <message>
            <source>Name axis</source>
            <translation>Achse benennen</translation>
        </message>
        <message>
            <source>Configure axis type</source>
            <translation>Achstyp einstellen</translation>
        </message>
        <message>
            <source>The numbers stay the same; only the unit changes, from mm to degrees or from degrees to mm.</source>
            <translation>Die Zahlen bleiben; nur die Einheit wechselt, von mm zu Grad oder von Grad zu mm.</translation>
        </message>
        <message>
            <source>Configure servo</source>
            <translation>Servo einstellen</translation>
        </message>
        <message>
            <source>Add axis {name}</source>
            <translation>Achse {name} hinzufügen</translation>
        </message>
        <message>
            <source>Delete axis</source>
            <translation>Achse löschen</translation>
        </message>
        <message>
            <source>The axis becomes unfitted and its values are set to their defaults. You can undo this.</source>
            <translation>Die Achse ist dann nicht mehr vorhanden, ihre Werte werden auf die Vorgaben gesetzt. Das lässt sich zurücknehmen.</translation>
        </message>
        <message>
            <source>Delete axis {name}</source>
            <translation>Achse {name} löschen</translation>
        </message>
        <message>
            <source>Copy axis</source>
            <translation>Achse kopieren</translation>
        </message>
        <message>
            <source>&amp;To axis</source>
            <translation>&amp;Auf Achse</translation>
        </message>
        <message>
            <source>All values of the axis are copied, except its name. Both axes must have the same type.</source>
            <translation>Alle Werte der Achse außer ihrem Namen werden kopiert. Beide Achsen müssen vom selben Typ sein.</translation>
        </message>
        <message>
            <source>Copy axis {source} to {target}</source>
            <translation>Achse {source} auf {target} kopieren</translation>
        </message>
        <message>
            <source>Swap axes</source>
            <translation>Achsen tauschen</translation>
        </message>
        <message>
            <source>&amp;With axis</source>
            <translation>&amp;Mit Achse</translation>
        </message>
        <message>
            <source>The axes change places with all their values. What names an axis by its number follows.</source>
            <translation>Die Achsen tauschen mit allen Werten die Plätze. Was eine Achse mit ihrer Nummer nennt, folgt.</translation>
        </message>
        <message>
            <source>Swap axes {first} and {second}</source>
            <translation>Achsen {first} und {second} tauschen</translation>
        </message>
        <message>
            <source>&amp;Undo</source>
            <translation>&amp;Zurücknehmen</translation>
        </message>
        <message>
            <source>&amp;Redo</source>
            <translation>&amp;Wiederholen</translation>
        </message>
        <message>
            <source>Open a project first: Project &gt; Open Project.</source>
            <translation>Erst ein Projekt öffnen: Projekt &gt; Projekt öffnen.</translation>
        </message>
        <message>
            <source>Project {name}: {count} in {folder}</source>
            <translation>Projekt {name}: {count} in {folder}</translation>
        </message>
        <message>
            <source>Folder of the new project</source>
            <translation>Ordner des neuen Projekts</translation>
        </message>
        <message>
            <source>Open project</source>
            <translation>Projekt öffnen</translation>
        </message>
        <message>
            <source>The project has no files of this kind.</source>
            <translation>Das Projekt hat keine solchen Dateien.</translation>
        </message>
        <message>
            <source>File</source>
            <translation>Datei</translation>
        </message>
        <message>
            <source>New name</source>
            <translation>Neuer Name</translation>
        </message>
        <message>
            <source>Open</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>The project has no files yet.</source>
            <translation>Das Projekt hat noch keine Dateien.</translation>
        </message>
        <message>
            <source>Check All Files</source>
            <translation>Alle Dateien prüfen</translation>
        </message>
        <message>
            <source>Copy</source>
            <translation>Kopieren</translation>
        </message>
        <message>
            <source>Copy from another project</source>
            <translation>Aus einem anderen Projekt kopieren</translation>
        </message>
        <message>
            <source>Copying</source>
            <translation>Kopieren</translation>
        </message>
        <message>
            <source>Rename</source>
            <translation>Umbenennen</translation>
        </message>
        <message>
            <source>Delete</source>
            <translation>Löschen</translation>
        </message>
        <message>
            <source>Delete {name}? It is kept as a backup and can be recovered.</source>
            <translation>{name} löschen? Sie bleibt als Sicherung und kann zurückgeholt werden.</translation>
        </message>
        <message>
            <source>&amp;Delete</source>
            <translation>&amp;Löschen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>{name} deleted</source>
            <translation>{name} gelöscht</translation>
        </message>
        <message>
            <source>Recover</source>
            <translation>Zurückholen</translation>
        </message>
        <message>
            <source>Control type</source>
            <translation>Steuerungstyp</translation>
        </message>
        <message>
            <source>&amp;System</source>
            <translation>&amp;System</translation>
        </message>
        <message>
            <source>&amp;Light</source>
            <translation>&amp;Hell</translation>
        </message>
        <message>
            <source>&amp;Dark</source>
            <translation>&amp;Dunkel</translation>
        </message>
        <message>
            <source>The language is another one when AMP Studio is started again.</source>
            <translation>Die Sprache ist nach dem nächsten Start von AMP Studio eine andere.</translation>
        </message>
        <message>
            <source>&amp;Motion… (not for {family})</source>
            <translation>B&amp;ewegung… (nicht für {family})</translation>
        </message>
        <message>
            <source>Motion (F9)</source>
            <translation>Bewegung (F9)</translation>
        </message>
        <message>
            <source>Loading the simulator</source>
            <translation>Der Simulator wird bereitgestellt</translation>
        </message>
    </context>
    <context>
        <name>AddAxisDialog</name>
        <message>
            <source>Add axis</source>
            <translation>Achse hinzufügen</translation>
        </message>
        <message>
            <source>Before {axis}</source>
            <translation>Vor {axis}</translation>
        </message>
        <message>
            <source>A&amp;dd Axis</source>
            <translation>Achse &amp;hinzufügen</translation>
        </message>
        <message>
            <source>&amp;Letter</source>
            <translation>&amp;Buchstabe</translation>
        </message>
        <message>
            <source>&amp;Place</source>
            <translation>&amp;Platz</translation>
        </message>
    </context>
    <context>
        <name>AskInDialogs</name>
        <message>
            <source>&amp;Continue checking</source>
            <translation>&amp;Weiter prüfen</translation>
        </message>
        <message>
            <source>&amp;Edit parameter</source>
            <translation>Parameter &amp;bearbeiten</translation>
        </message>
        <message>
            <source>&amp;Quit checking</source>
            <translation>Prüfen be&amp;enden</translation>
        </message>
        <message>
            <source>Out of range</source>
            <translation>Außerhalb des Bereichs</translation>
        </message>
        <message>
            <source>Edit parameter</source>
            <translation>Parameter bearbeiten</translation>
        </message>
    </context>
    <context>
        <name>AxisComparison</name>
        <message>
            <source>Compare axes</source>
            <translation>Achsen vergleichen</translation>
        </message>
        <message>
            <source>First axis</source>
            <translation>Erste Achse</translation>
        </message>
        <message>
            <source>Second axis</source>
            <translation>Zweite Achse</translation>
        </message>
        <message>
            <source>Parameters that differ</source>
            <translation>Parameter, die sich unterscheiden</translation>
        </message>
        <message>
            <source>&amp;First axis</source>
            <translation>&amp;Erste Achse</translation>
        </message>
        <message>
            <source>&amp;Second axis</source>
            <translation>&amp;Zweite Achse</translation>
        </message>
        <message>
            <source>&amp;Close</source>
            <translation>Sch&amp;ließen</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>&amp;Take for {axis}</source>
            <translation>Für {axis} &amp;nehmen</translation>
        </message>
        <message>
            <source>Ta&amp;ke for {axis}</source>
            <translation>Für {axis} ne&amp;hmen</translation>
        </message>
        <message>
            <source>1 parameter differs</source>
            <translation>1 Parameter unterscheidet sich</translation>
        </message>
        <message>
            <source>{count} parameters differ</source>
            <translation>{count} Parameter unterscheiden sich</translation>
        </message>
        <message>
            <source>No differences</source>
            <translation>Keine Unterschiede</translation>
        </message>
        <message>
            <source>yes</source>
            <translation>ja</translation>
        </message>
        <message>
            <source>no</source>
            <translation>nein</translation>
        </message>
        <message>
            <source>Take values of axis {source} for {target}</source>
            <translation>Werte der Achse {source} für {target} nehmen</translation>
        </message>
    </context>
    <context>
        <name>AxisDialog</name>
        <message>
            <source>&amp;Axis</source>
            <translation>&amp;Achse</translation>
        </message>
        <message>
            <source>&amp;Letter</source>
            <translation>&amp;Buchstabe</translation>
        </message>
    </context>
    <context>
        <name>AxisHeads</name>
        <message>
            <source>Axes</source>
            <translation>Achsen</translation>
        </message>
    </context>
    <context>
        <name>BlockPreview</name>
        <message>
            <source>Paste from a Spreadsheet</source>
            <translation>Aus einer Tabellenkalkulation einfügen</translation>
        </message>
        <message numerus="yes">
            <source>%n cells</source>
            <translation>
                <numerusform>%n Zelle</numerusform>
                <numerusform>%n Zellen</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n change</source>
            <translation>
                <numerusform>%n ändert sich</numerusform>
                <numerusform>%n ändern sich</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n the same</source>
            <translation>
                <numerusform>%n gleich</numerusform>
                <numerusform>%n gleich</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n refused</source>
            <translation>
                <numerusform>%n abgelehnt</numerusform>
                <numerusform>%n abgelehnt</numerusform>
            </translation>
        </message>
        <message>
            <source>Value</source>
            <translation>Wert</translation>
        </message>
        <message>
            <source>Now</source>
            <translation>Jetzt</translation>
        </message>
        <message>
            <source>Becomes</source>
            <translation>Wird</translation>
        </message>
        <message>
            <source>Changes</source>
            <translation>Änderungen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message numerus="yes">
            <source>&amp;Paste %n</source>
            <translation>
                <numerusform>%n &amp;einfügen</numerusform>
                <numerusform>%n &amp;einfügen</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>CalculatorDialog</name>
        <message>
            <source>Calculator</source>
            <translation>Rechner</translation>
        </message>
        <message>
            <source>&amp;Formula</source>
            <translation>&amp;Formel</translation>
        </message>
        <message>
            <source>Result</source>
            <translation>Ergebnis</translation>
        </message>
        <message>
            <source>Use the result as a value</source>
            <translation>Das Ergebnis als Wert nehmen</translation>
        </message>
        <message>
            <source>Still needed: {names}</source>
            <translation>Noch nötig: {names}</translation>
        </message>
        <message>
            <source>Use the result as the value of {label}{what}</source>
            <translation>Das Ergebnis als Wert von {label}{what} nehmen</translation>
        </message>
    </context>
    <context>
        <name>CalibrationPage</name>
        <message>
            <source>measured position</source>
            <translation>gemessene Position</translation>
        </message>
        <message>
            <source>deviation</source>
            <translation>Abweichung</translation>
        </message>
        <message>
            <source>most positive position</source>
            <translation>positivste Position</translation>
        </message>
        <message>
            <source>most negative position</source>
            <translation>negativste Position</translation>
        </message>
        <message>
            <source>Errors that the table takes away</source>
            <translation>Fehler, die die Tabelle wegnimmt</translation>
        </message>
        <message>
            <source>Calibration is &amp;on while points are measured</source>
            <translation>Kalibrierung ist beim Messen &amp;eingeschaltet</translation>
        </message>
        <message>
            <source>A figure that is put in is what the table has left over, and is added to it (page 36-10)</source>
            <translation>Eine eingegebene Zahl ist der Rest, den die Tabelle gelassen hat, und wird addiert (Seite 36-10)</translation>
        </message>
        <message>
            <source>&amp;Insert Point…</source>
            <translation>Punkt &amp;einfügen…</translation>
        </message>
        <message>
            <source>&amp;Replace</source>
            <translation>E&amp;rsetzen</translation>
        </message>
        <message>
            <source>De&amp;lete Point</source>
            <translation>Punkt &amp;löschen</translation>
        </message>
        <message>
            <source>Delete All Poin&amp;ts</source>
            <translation>&amp;Alle Punkte löschen</translation>
        </message>
        <message>
            <source>Read &amp;Measured Points…</source>
            <translation>&amp;Messpunkte lesen…</translation>
        </message>
        <message>
            <source>Points of the calibration table</source>
            <translation>Punkte der Kalibriertabelle</translation>
        </message>
        <message>
            <source>A&amp;xis</source>
            <translation>A&amp;chse</translation>
        </message>
        <message>
            <source>&amp;Figures are</source>
            <translation>&amp;Zahlen sind</translation>
        </message>
        <message>
            <source>Starts at the</source>
            <translation>Beginnt an der</translation>
        </message>
        <message>
            <source>This control has no calibration table of an axis, only a reversal error.</source>
            <translation>Diese Steuerung hat keine Kalibriertabelle einer Achse, nur eine Umkehrspanne.</translation>
        </message>
        <message>
            <source>error that the table takes away</source>
            <translation>Fehler, den die Tabelle wegnimmt</translation>
        </message>
        <message>
            <source>&amp;New Table</source>
            <translation>&amp;Neue Tabelle</translation>
        </message>
        <message>
            <source>Can be chosen again when all points are deleted (page 36-6)</source>
            <translation>Ist wieder wählbar, wenn alle Punkte gelöscht sind (Seite 36-6)</translation>
        </message>
        <message>
            <source>Measured</source>
            <translation>Gemessen</translation>
        </message>
        <message>
            <source>Deviation</source>
            <translation>Abweichung</translation>
        </message>
        <message>
            <source>Correction</source>
            <translation>Korrektur</translation>
        </message>
        <message>
            <source>Control Reads</source>
            <translation>Steuerung liest</translation>
        </message>
        <message>
            <source>Error</source>
            <translation>Fehler</translation>
        </message>
        <message>
            <source>New table of</source>
            <translation>Neue Tabelle von</translation>
        </message>
        <message>
            <source>Position that the control reads ({unit}), and the figure beside it:</source>
            <translation>Position, die die Steuerung liest ({unit}), und die Zahl daneben:</translation>
        </message>
        <message>
            <source>Insert Point</source>
            <translation>Punkt einfügen</translation>
        </message>
        <message>
            <source>{text} is not a position and a figure, as 100 0.004.</source>
            <translation>{text} ist keine Position mit einer Zahl wie 100 0.004.</translation>
        </message>
        <message>
            <source>Insert point of</source>
            <translation>Punkt einfügen bei</translation>
        </message>
        <message>
            <source>Replace point of</source>
            <translation>Punkt ersetzen bei</translation>
        </message>
        <message>
            <source>Delete point of</source>
            <translation>Punkt löschen bei</translation>
        </message>
        <message>
            <source>Delete all points of</source>
            <translation>Alle Punkte löschen bei</translation>
        </message>
    </context>
    <context>
        <name>CheckWindow</name>
        <message>
            <source>Check in Motion</source>
            <translation>Bewegung prüfen</translation>
        </message>
        <message>
            <source>Verdict</source>
            <translation>Urteil</translation>
        </message>
        <message>
            <source>Scenario</source>
            <translation>Szenario</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>What is not good</source>
            <translation>Was nicht gut ist</translation>
        </message>
        <message>
            <source>Figures</source>
            <translation>Zahlen</translation>
        </message>
        <message>
            <source>Checks of the machine in motion</source>
            <translation>Prüfungen der Maschine in Bewegung</translation>
        </message>
        <message>
            <source>&amp;Close</source>
            <translation>Sch&amp;ließen</translation>
        </message>
        <message>
            <source>good</source>
            <translation>gut</translation>
        </message>
        <message>
            <source>doubtful</source>
            <translation>zweifelhaft</translation>
        </message>
        <message>
            <source>bad</source>
            <translation>schlecht</translation>
        </message>
        <message>
            <source>not possible</source>
            <translation>nicht möglich</translation>
        </message>
        <message>
            <source>checking …</source>
            <translation>prüft …</translation>
        </message>
    </context>
    <context>
        <name>ChoiceBox</name>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source>{typed}: no choice</source>
            <translation>{typed}: keine Auswahl</translation>
        </message>
    </context>
    <context>
        <name>Comparisons</name>
        <message>
            <source>Compare</source>
            <translation>Vergleichen</translation>
        </message>
        <message>
            <source>Opening</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>Compare with</source>
            <translation>Vergleichen mit</translation>
        </message>
        <message>
            <source>Compare with a copy</source>
            <translation>Mit einer Kopie vergleichen</translation>
        </message>
        <message numerus="yes">
            <source>Merged with {source}. Values changed: %n.</source>
            <translation>
                <numerusform>Mit {source} zusammengeführt. Werte geändert: %n.</numerusform>
                <numerusform>Mit {source} zusammengeführt. Werte geändert: %n.</numerusform>
            </translation>
        </message>
        <message>
            <source>&amp;Undo</source>
            <translation>&amp;Zurücknehmen</translation>
        </message>
        <message>
            <source>Save result as</source>
            <translation>Ergebnis speichern unter</translation>
        </message>
    </context>
    <context>
        <name>ConditionLine</name>
        <message>
            <source>Conditions</source>
            <translation>Bedingungen</translation>
        </message>
    </context>
    <context>
        <name>ControlDesk</name>
        <message>
            <source>{name}: {state} (Alt+0)</source>
            <translation>{name}: {state} (Alt+0)</translation>
        </message>
        <message>
            <source>Something is being sent to a control: look at it afterwards.</source>
            <translation>Es wird gerade etwas an eine Steuerung gesendet: danach ansehen.</translation>
        </message>
        <message>
            <source>Stopped: an exchange is under way.</source>
            <translation>Angehalten: ein Austausch läuft.</translation>
        </message>
        <message>
            <source>Starting an emulated control …</source>
            <translation>Eine nachgebildete Steuerung wird gestartet …</translation>
        </message>
        <message>
            <source>Emulated control at {address}, in E-stop</source>
            <translation>Nachgebildete Steuerung an {address}, im Not-Halt</translation>
        </message>
        <message>
            <source>The emulated control stopped: {output}</source>
            <translation>Die nachgebildete Steuerung endete: {output}</translation>
        </message>
        <message>
            <source>Emulated control stopped</source>
            <translation>Nachgebildete Steuerung beendet</translation>
        </message>
        <message>
            <source>Emulated control: {line}</source>
            <translation>Nachgebildete Steuerung: {line}</translation>
        </message>
        <message>
            <source>Read</source>
            <translation>Auslesen</translation>
        </message>
        <message>
            <source>Restore</source>
            <translation>Wiederherstellen</translation>
        </message>
        <message>
            <source>Enter Values by Hand</source>
            <translation>Werte von Hand eingeben</translation>
        </message>
        <message>
            <source>Connect</source>
            <translation>Verbinden</translation>
        </message>
        <message>
            <source>Emulated control</source>
            <translation>Nachgebildete Steuerung</translation>
        </message>
        <message>
            <source>emulated</source>
            <translation>nachgebildet</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>none chosen</source>
            <translation>keine gewählt</translation>
        </message>
        <message>
            <source>Opening</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>Upload cancelled. No file was written.</source>
            <translation>Auslesen abgebrochen. Keine Datei wurde geschrieben.</translation>
        </message>
        <message>
            <source>Save upload as</source>
            <translation>Ausgelesenes speichern unter</translation>
        </message>
        <message>
            <source>Upload</source>
            <translation>Auslesen</translation>
        </message>
        <message>
            <source>{error}.

Choose another name.</source>
            <translation>{error}.

Einen anderen Namen wählen.</translation>
        </message>
    </context>
    <context>
        <name>ControlExchange</name>
        <message>
            <source>Connect</source>
            <translation>Verbinden</translation>
        </message>
    </context>
    <context>
        <name>ControlPage</name>
        <message>
            <source>Direction</source>
            <translation>Richtung</translation>
        </message>
        <message>
            <source>Compare</source>
            <translation>Vergleichen</translation>
        </message>
        <message>
            <source>Send to the Control</source>
            <translation>An Steuerung senden</translation>
        </message>
        <message>
            <source>Read From It</source>
            <translation>Auslesen</translation>
        </message>
        <message>
            <source>Password of the control; Enter tries it</source>
            <translation>Passwort der Steuerung; Enter versucht es</translation>
        </message>
        <message>
            <source>Password of the control</source>
            <translation>Passwort der Steuerung</translation>
        </message>
        <message>
            <source>Name or number</source>
            <translation>Name oder Nummer</translation>
        </message>
        <message>
            <source>Filter the differences</source>
            <translation>Unterschiede filtern</translation>
        </message>
        <message>
            <source>Write This One Now</source>
            <translation>Diesen jetzt schreiben</translation>
        </message>
        <message>
            <source>Save Proof…</source>
            <translation>Nachweis sichern…</translation>
        </message>
        <message>
            <source>Read Again</source>
            <translation>Neu auslesen</translation>
        </message>
        <message>
            <source>Back to the values (Escape)</source>
            <translation>Zurück zu den Werten (Escape)</translation>
        </message>
        <message>
            <source>a new file</source>
            <translation>eine neue Datei</translation>
        </message>
        <message>
            <source>{differ} differ, {same} are the same</source>
            <translation>{differ} verschieden, {same} gleich</translation>
        </message>
        <message>
            <source>{kept} kept</source>
            <translation>{kept} behalten</translation>
        </message>
        <message>
            <source>Choose a control at the left, or add one by its address with “+”.
An emulated control is in the menu Control.</source>
            <translation>Links eine Steuerung wählen, oder mit „+“ eine mit ihrer Adresse hinzufügen.
Eine nachgebildete Steuerung ist im Menü Steuerung.</translation>
        </message>
        <message>
            <source>Reading what {name} contains …</source>
            <translation>{name} wird ausgelesen …</translation>
        </message>
        <message>
            <source>The control contains no parameters.</source>
            <translation>Die Steuerung enthält keine Parameter.</translation>
        </message>
        <message>
            <source>Read at {time}</source>
            <translation>Ausgelesen {time}</translation>
        </message>
        <message>
            <source>{name} contains all new values.</source>
            <translation>{name} enthält alle neuen Werte.</translation>
        </message>
        <message>
            <source>Kept as they were: {names}</source>
            <translation>Behalten, wie sie waren: {names}</translation>
        </message>
        <message>
            <source>Checksum before {before}, now {now}</source>
            <translation>Prüfsumme vorher {before}, jetzt {now}</translation>
        </message>
        <message>
            <source>Try Again</source>
            <translation>Noch einmal</translation>
        </message>
        <message>
            <source>By Hand</source>
            <translation>Von Hand</translation>
        </message>
        <message>
            <source>Exchanges of This File</source>
            <translation>Austausch dieser Datei</translation>
        </message>
        <message>
            <source>several controls</source>
            <translation>mehrere Steuerungen</translation>
        </message>
        <message>
            <source>{only}: “By Hand” makes the sheet for that.</source>
            <translation>{only}: „Von Hand“ macht das Blatt dafür.</translation>
        </message>
        <message>
            <source>Press E-stop at the machine. While an axis can move, the control takes no parameters.</source>
            <translation>Not-Halt an der Maschine drücken. Solange sich eine Achse bewegen kann, nimmt die Steuerung keine Parameter an.</translation>
        </message>
        <message>
            <source>Ask Now</source>
            <translation>Jetzt fragen</translation>
        </message>
        <message>
            <source>{name} has unsaved changes. A download sends the saved file.</source>
            <translation>{name} hat ungespeicherte Änderungen. Gesendet wird die gespeicherte Datei.</translation>
        </message>
        <message>
            <source>Save</source>
            <translation>Speichern</translation>
        </message>
        <message>
            <source>The file has {count}, the first: {message}</source>
            <translation>Die Datei hat {count}, der erste: {message}</translation>
        </message>
        <message numerus="yes">
            <source>%n errors</source>
            <translation>
                <numerusform>%n Fehler</numerusform>
                <numerusform>%n Fehler</numerusform>
            </translation>
        </message>
        <message>
            <source>Send It With Its Errors</source>
            <translation>Mit den Fehlern senden</translation>
        </message>
        <message>
            <source>There is no digest beside {name}, so its content cannot be checked.</source>
            <translation>Neben {name} liegt keine Prüfsumme, so dass der Inhalt nicht geprüft werden kann.</translation>
        </message>
        <message>
            <source>{name} is restored byte for byte, but cannot be shown: {why}.</source>
            <translation>{name} wird Byte für Byte wiederhergestellt, kann aber nicht gezeigt werden: {why}.</translation>
        </message>
        <message>
            <source>The control contains all old values.</source>
            <translation>Die Steuerung enthält alle alten Werte.</translation>
        </message>
        <message>
            <source>The control contains all new values.</source>
            <translation>Die Steuerung enthält alle neuen Werte.</translation>
        </message>
        <message>
            <source>The control contains some of both: new and old values.</source>
            <translation>Die Steuerung enthält teils neue, teils alte Werte.</translation>
        </message>
        <message>
            <source>It is not known what the control contains.</source>
            <translation>Es ist nicht bekannt, was die Steuerung enthält.</translation>
        </message>
        <message>
            <source>Do not move the machine before it was read.</source>
            <translation>Die Maschine nicht bewegen, bevor sie ausgelesen ist.</translation>
        </message>
        <message>
            <source>Keep {value}</source>
            <translation>{value} behalten</translation>
        </message>
        <message numerus="yes">
            <source>I have checked what can be dangerous: %n</source>
            <translation>
                <numerusform>Ich habe geprüft, was gefährlich sein kann: %n</numerusform>
                <numerusform>Ich habe geprüft, was gefährlich sein kann: %n</numerusform>
            </translation>
        </message>
        <message>
            <source>Tied to what you see: if the control changes before, nothing is replaced.</source>
            <translation>An das Gezeigte gebunden: ändert sich die Steuerung vorher, wird nichts ersetzt.</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>Cancel, Keep All Old Values</source>
            <translation>Abbrechen, alle alten Werte behalten</translation>
        </message>
        <message>
            <source>Cancel, Leave What Is Confirmed</source>
            <translation>Abbrechen, Bestätigtes bleibt</translation>
        </message>
        <message>
            <source>Connect and Read</source>
            <translation>Verbinden und auslesen</translation>
        </message>
        <message>
            <source>Back to the Values</source>
            <translation>Zurück zu den Werten</translation>
        </message>
        <message numerus="yes">
            <source>Send %n Values to the Control…</source>
            <translation>
                <numerusform>%n Wert an Steuerung senden…</numerusform>
                <numerusform>%n Werte an Steuerung senden…</numerusform>
            </translation>
        </message>
        <message>
            <source>Restore {name}</source>
            <translation>{name} wiederherstellen</translation>
        </message>
        <message numerus="yes">
            <source>Send %n Values to the Control</source>
            <translation>
                <numerusform>%n Wert an Steuerung senden</numerusform>
                <numerusform>%n Werte an Steuerung senden</numerusform>
            </translation>
        </message>
        <message>
            <source>No difference: there is nothing to send.</source>
            <translation>Kein Unterschied: es gibt nichts zu senden.</translation>
        </message>
        <message>
            <source>Save as a New File…</source>
            <translation>Als neue Datei sichern…</translation>
        </message>
        <message>
            <source>Nothing that can be read is in the control.</source>
            <translation>In der Steuerung ist nichts Lesbares.</translation>
        </message>
        <message>
            <source>The file is read-only.</source>
            <translation>Die Datei ist schreibgeschützt.</translation>
        </message>
        <message numerus="yes">
            <source>Take %n Values into {name}</source>
            <translation>
                <numerusform>%n Wert in {name} übernehmen</numerusform>
                <numerusform>%n Werte in {name} übernehmen</numerusform>
            </translation>
        </message>
        <message>
            <source>Waiting: {what}</source>
            <translation>Wartet: {what}</translation>
        </message>
        <message>
            <source>Waiting: the file is not saved</source>
            <translation>Wartet: die Datei ist nicht gesichert</translation>
        </message>
        <message>
            <source>Waiting: the file has errors</source>
            <translation>Wartet: die Datei hat Fehler</translation>
        </message>
        <message>
            <source>Waiting: what can be dangerous is not checked</source>
            <translation>Wartet: was gefährlich sein kann, ist nicht geprüft</translation>
        </message>
        <message>
            <source>kept at the control</source>
            <translation>an der Steuerung behalten</translation>
        </message>
        <message>
            <source>Read from {name}</source>
            <translation>Aus {name} ausgelesen</translation>
        </message>
        <message>
            <source>Stopping at the next safe point …</source>
            <translation>Hält an der nächsten sicheren Stelle an …</translation>
        </message>
        <message>
            <source>The line is cut; trying again …</source>
            <translation>Die Leitung ist unterbrochen; neuer Versuch …</translation>
        </message>
        <message>
            <source>No answer for {done} s; trying again …</source>
            <translation>Keine Antwort seit {done} s; neuer Versuch …</translation>
        </message>
    </context>
    <context>
        <name>ControlTarget</name>
        <message>
            <source>Download</source>
            <translation>An Steuerung senden</translation>
        </message>
        <message>
            <source>Put Back</source>
            <translation>Zurücklegen</translation>
        </message>
        <message>
            <source>Read Control</source>
            <translation>Steuerung lesen</translation>
        </message>
        <message>
            <source>Takes effect: {when}.</source>
            <translation>Wirkt: {when}.</translation>
        </message>
    </context>
    <context>
        <name>Corner</name>
        <message>
            <source>No.</source>
            <translation>Nr.</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
    </context>
    <context>
        <name>DetailPage</name>
        <message>
            <source>Notes</source>
            <translation>Notizen</translation>
        </message>
        <message>
            <source>Calculated</source>
            <translation>Berechnet</translation>
        </message>
        <message>
            <source>Help</source>
            <translation>Hilfe</translation>
        </message>
        <message>
            <source>Where else</source>
            <translation>Wo sonst noch</translation>
        </message>
        <message>
            <source>History</source>
            <translation>Verlauf</translation>
        </message>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source> (page {page})</source>
            <translation> (Seite {page})</translation>
        </message>
        <message>
            <source>no bounds printed, in {shown}</source>
            <translation>keine Grenzen gedruckt, in {shown}</translation>
        </message>
        <message>
            <source> (set by {name})</source>
            <translation> (bestimmt durch {name})</translation>
        </message>
        <message>
            <source> — no range in degrees is printed; the metric numbers are used</source>
            <translation> — kein Bereich in Grad ist gedruckt; die metrischen Zahlen gelten</translation>
        </message>
        <message>
            <source>{number} more are met</source>
            <translation>{number} weitere sind erfüllt</translation>
        </message>
        <message>
            <source>Rules</source>
            <translation>Regeln</translation>
        </message>
        <message>
            <source>{unmet} of {number} not met</source>
            <translation>{unmet} von {number} nicht erfüllt</translation>
        </message>
        <message>
            <source>Saved</source>
            <translation>Gespeichert</translation>
        </message>
        <message>
            <source>In the control, {time}</source>
            <translation>In der Steuerung, {time}</translation>
        </message>
        <message>
            <source>Last download, {time}</source>
            <translation>Letzte Sendung, {time}</translation>
        </message>
        <message>
            <source>Last download</source>
            <translation>Letzte Sendung</translation>
        </message>
    </context>
    <context>
        <name>DetailPanel</name>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>Value</source>
            <translation>Wert</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>Use the calculated value</source>
            <translation>Den berechneten Wert nehmen</translation>
        </message>
        <message>
            <source>not known</source>
            <translation>nicht bekannt</translation>
        </message>
    </context>
    <context>
        <name>DifferenceTable</name>
        <message>
            <source>Differences</source>
            <translation>Unterschiede</translation>
        </message>
        <message>
            <source>No.</source>
            <translation>Nr.</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>Mind</source>
            <translation>Zu beachten</translation>
        </message>
        <message>
            <source>On one side only, kept as they are</source>
            <translation>Nur auf einer Seite, bleiben wie sie sind</translation>
        </message>
        <message>
            <source>Axes that are not fitted</source>
            <translation>Nicht vorhandene Achsen</translation>
        </message>
        <message>
            <source>stays as it is</source>
            <translation>bleibt, wie er ist</translation>
        </message>
        <message>
            <source>the control's value stays</source>
            <translation>Wert der Steuerung bleibt</translation>
        </message>
        <message>
            <source>danger, page {page}</source>
            <translation>Gefahr, Seite {page}</translation>
        </message>
        <message>
            <source>the file's value</source>
            <translation>Wert der Datei</translation>
        </message>
        <message>
            <source>the control's value</source>
            <translation>Wert der Steuerung</translation>
        </message>
    </context>
    <context>
        <name>DiskWatch</name>
        <message>
            <source>{name} was removed or renamed by another program. Your work is still open: save it under a new name.</source>
            <translation>{name} wurde von einem anderen Programm entfernt oder umbenannt. Die Arbeit ist noch offen: unter neuem Namen speichern.</translation>
        </message>
        <message>
            <source>Co&amp;mpare…</source>
            <translation>&amp;Vergleichen…</translation>
        </message>
        <message>
            <source>&amp;Reload</source>
            <translation>&amp;Neu lesen</translation>
        </message>
        <message>
            <source>{name} was changed by another program while you have unsaved changes. Compare both, then save.</source>
            <translation>{name} wurde von einem anderen Programm geändert, und es gibt ungespeicherte Änderungen. Erst vergleichen, dann speichern.</translation>
        </message>
        <message>
            <source>{name} was changed by another program.</source>
            <translation>{name} wurde von einem anderen Programm geändert.</translation>
        </message>
        <message>
            <source>Reload {name}? Your unsaved changes will be lost.</source>
            <translation>{name} neu lesen? Die ungespeicherten Änderungen gehen verloren.</translation>
        </message>
        <message>
            <source>Reload</source>
            <translation>Neu lesen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
    </context>
    <context>
        <name>Docks</name>
        <message>
            <source>Panel</source>
            <translation>Feld</translation>
        </message>
    </context>
    <context>
        <name>Edits</name>
        <message>
            <source>Value not accepted</source>
            <translation>Wert nicht angenommen</translation>
        </message>
        <message>
            <source>{name}: {error}.

Nothing was changed.</source>
            <translation>{name}: {error}.

Nichts wurde geändert.</translation>
        </message>
        <message>
            <source>&amp;Force and Mark</source>
            <translation>&amp;Erzwingen und kennzeichnen</translation>
        </message>
        <message>
            <source>{problem}.

Nothing was changed. A forced value is marked in the file, the findings and the report.</source>
            <translation>{problem}.

Nichts wurde geändert. Ein erzwungener Wert ist in der Datei, den Befunden und dem Bericht gekennzeichnet.</translation>
        </message>
        <message>
            <source>Out of range</source>
            <translation>Außerhalb des Bereichs</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>No formulas are published for {name}.</source>
            <translation>Für {name} sind keine Formeln veröffentlicht.</translation>
        </message>
        <message>
            <source>The selected finding has no suggested fix. Show it to see the parameters to check.</source>
            <translation>Der gewählte Befund hat keinen Vorschlag. Die Erklärung nennt die zu prüfenden Parameter.</translation>
        </message>
        <message>
            <source>No finding is selected.</source>
            <translation>Kein Befund ist ausgewählt.</translation>
        </message>
        <message>
            <source>This finding has changed or no longer exists. Select it again in the list of findings.</source>
            <translation>Dieser Befund hat sich geändert oder besteht nicht mehr. In der Liste neu auswählen.</translation>
        </message>
        <message>
            <source>Fix: {step_text}</source>
            <translation>Behoben: {step_text}</translation>
        </message>
        <message>
            <source>Fix several</source>
            <translation>Mehrere behoben</translation>
        </message>
        <message>
            <source>These findings have changed or no longer exist. Select them again in the list of findings.</source>
            <translation>Diese Befunde haben sich geändert oder bestehen nicht mehr. In der Liste neu auswählen.</translation>
        </message>
        <message>
            <source>No finding has a suggested fix.</source>
            <translation>Kein Befund hat einen Vorschlag.</translation>
        </message>
        <message>
            <source>Apply all safe fixes</source>
            <translation>Alle sicheren Korrekturen anwenden</translation>
        </message>
        <message>
            <source>There is no safe fix: no finding has a suggested fix that cannot change motion.</source>
            <translation>Es gibt keine sichere Korrektur: kein Befund hat einen Vorschlag, der keine Bewegung ändern kann.</translation>
        </message>
    </context>
    <context>
        <name>EmulatedControl</name>
        <message>
            <source>it stopped unexpectedly</source>
            <translation>sie endete unerwartet</translation>
        </message>
    </context>
    <context>
        <name>ErrorPlot</name>
        <message>
            <source>No points</source>
            <translation>Keine Punkte</translation>
        </message>
    </context>
    <context>
        <name>ExchangeHistory</name>
        <message>
            <source>When</source>
            <translation>Wann</translation>
        </message>
        <message>
            <source>Who</source>
            <translation>Wer</translation>
        </message>
        <message>
            <source>Exchange</source>
            <translation>Austausch</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>Before</source>
            <translation>Vorher</translation>
        </message>
        <message>
            <source>After</source>
            <translation>Nachher</translation>
        </message>
        <message>
            <source>How it ended</source>
            <translation>Wie es endete</translation>
        </message>
        <message>
            <source>Recorded exchanges</source>
            <translation>Aufgezeichneter Austausch</translation>
        </message>
        <message>
            <source>Restore What It Replaced…</source>
            <translation>Ersetztes wiederherstellen…</translation>
        </message>
        <message>
            <source>
Kept copy: {kept}</source>
            <translation>
Behaltene Kopie: {kept}</translation>
        </message>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source>{upper}{what} recorded in {parent}.</source>
            <translation>{upper}{what} aufgezeichnet in {parent}.</translation>
        </message>
    </context>
    <context>
        <name>ExchangeSteps</name>
        <message>
            <source>What will happen</source>
            <translation>Was geschehen wird</translation>
        </message>
        <message>
            <source>Mind</source>
            <translation>Zu beachten</translation>
        </message>
        <message>
            <source>Dangers of the values that change</source>
            <translation>Gefahren der Werte, die sich ändern</translation>
        </message>
        <message>
            <source>Under way</source>
            <translation>Unterwegs</translation>
        </message>
        <message>
            <source>What happened</source>
            <translation>Was geschah</translation>
        </message>
    </context>
    <context>
        <name>FactsDialog</name>
        <message>
            <source>Machine facts</source>
            <translation>Angaben zur Maschine</translation>
        </message>
        <message>
            <source>&amp;Name</source>
            <translation>&amp;Name</translation>
        </message>
        <message>
            <source>&amp;Application</source>
            <translation>&amp;Anwendung</translation>
        </message>
        <message>
            <source>Control software &amp;revision</source>
            <translation>&amp;Softwarestand der Steuerung</translation>
        </message>
        <message>
            <source>Change &amp;Facts</source>
            <translation>&amp;Angaben ändern</translation>
        </message>
    </context>
    <context>
        <name>FilePage</name>
        <message>
            <source>Not set</source>
            <translation>Nicht gesetzt</translation>
        </message>
        <message>
            <source>Found: {words}</source>
            <translation>Gefunden: {words}</translation>
        </message>
        <message>
            <source>Step</source>
            <translation>Schritt</translation>
        </message>
        <message>
            <source>Group</source>
            <translation>Gruppe</translation>
        </message>
        <message>
            <source>, {hidden} hidden (Ctrl+H shows them)</source>
            <translation>, {hidden} verborgen (Strg+H zeigt sie)</translation>
        </message>
        <message>
            <source>, filtered (Ctrl+0 shows all)</source>
            <translation>, gefiltert (Strg+0 zeigt alle)</translation>
        </message>
        <message>
            <source>, read by {command}</source>
            <translation>, gelesen durch {command}</translation>
        </message>
        <message numerus="yes">
            <source>%n cells</source>
            <translation>
                <numerusform>%n Zelle</numerusform>
                <numerusform>%n Zellen</numerusform>
            </translation>
        </message>
        <message>
            <source>{first} to {last}</source>
            <translation>{first} bis {last}</translation>
        </message>
        <message numerus="yes">
            <source>%n cells of {name}</source>
            <translation>
                <numerusform>%n Zelle von {name}</numerusform>
                <numerusform>%n Zellen von {name}</numerusform>
            </translation>
        </message>
        <message>
            <source>min {number}</source>
            <translation>min {number}</translation>
        </message>
        <message>
            <source>max {number}</source>
            <translation>max {number}</translation>
        </message>
        <message>
            <source>{describe} is not available on this machine type</source>
            <translation>{describe} gibt es bei diesem Maschinentyp nicht</translation>
        </message>
        <message>
            <source>{name} is not available on this machine type</source>
            <translation>{name} gibt es bei diesem Maschinentyp nicht</translation>
        </message>
    </context>
    <context>
        <name>FileTabs</name>
        <message>
            <source>Open files</source>
            <translation>Offene Dateien</translation>
        </message>
        <message>
            <source>Open files beside</source>
            <translation>Offene Dateien daneben</translation>
        </message>
        <message>
            <source>{name}, not saved</source>
            <translation>{name}, nicht gespeichert</translation>
        </message>
        <message>
            <source>&amp;Close</source>
            <translation>Sch&amp;ließen</translation>
        </message>
        <message>
            <source>Close &amp;Others</source>
            <translation>&amp;Andere schließen</translation>
        </message>
        <message>
            <source>Show &amp;Beside</source>
            <translation>&amp;Daneben zeigen</translation>
        </message>
        <message>
            <source>Copy &amp;Path</source>
            <translation>&amp;Pfad kopieren</translation>
        </message>
    </context>
    <context>
        <name>FileTarget</name>
        <message>
            <source>The file is read-only: another program has it open.</source>
            <translation>Die Datei ist schreibgeschützt: ein anderes Programm hat sie offen.</translation>
        </message>
    </context>
    <context>
        <name>Files</name>
        <message>
            <source>Reading the families</source>
            <translation>Die Familien werden gelesen</translation>
        </message>
        <message>
            <source>New parameter file</source>
            <translation>Neue Parameterdatei</translation>
        </message>
        <message>
            <source>Copy of an example</source>
            <translation>Kopie eines Beispiels</translation>
        </message>
        <message>
            <source>{name} already exists. Replace it? The existing file becomes its backup.</source>
            <translation>{name} gibt es schon. Ersetzen? Die vorhandene Datei wird zur Sicherung.</translation>
        </message>
        <message>
            <source>&amp;Replace</source>
            <translation>E&amp;rsetzen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>{name} is open in a tab. Close it first, or choose another name.</source>
            <translation>{name} ist in einem Reiter offen. Erst schließen oder einen anderen Namen wählen.</translation>
        </message>
        <message>
            <source>Saving</source>
            <translation>Speichern</translation>
        </message>
        <message>
            <source>Open</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>Opening</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>{error}.

Open it read-only?</source>
            <translation>{error}.

Nur zum Lesen öffnen?</translation>
        </message>
        <message>
            <source>File in use</source>
            <translation>Datei in Gebrauch</translation>
        </message>
        <message>
            <source>&amp;Open Read-Only</source>
            <translation>Nur zum &amp;Lesen öffnen</translation>
        </message>
        <message>
            <source>Not opened again: {list}</source>
            <translation>Nicht wieder geöffnet: {list}</translation>
        </message>
        <message>
            <source>

The file was changed since then. Check the recovered values.</source>
            <translation>

Die Datei wurde seitdem geändert. Die wiederhergestellten Werte prüfen.</translation>
        </message>
        <message>
            <source>The program ended before {count} from {day_and_time} ({who}) could be saved.{note}

Recover the unsaved work? You can undo this.</source>
            <translation>Das Programm endete, bevor {count} von {day_and_time} ({who}) gespeichert werden konnten.{note}

Die ungespeicherte Arbeit wiederherstellen? Das lässt sich zurücknehmen.</translation>
        </message>
        <message>
            <source>Unsaved work found</source>
            <translation>Ungespeicherte Arbeit gefunden</translation>
        </message>
        <message>
            <source>&amp;Recover</source>
            <translation>&amp;Wiederherstellen</translation>
        </message>
        <message>
            <source>&amp;Discard</source>
            <translation>&amp;Verwerfen</translation>
        </message>
        <message>
            <source>Decide &amp;Later</source>
            <translation>&amp;Später entscheiden</translation>
        </message>
        <message>
            <source>Recover unsaved work</source>
            <translation>Ungespeicherte Arbeit wiederherstellen</translation>
        </message>
        <message>
            <source>Save as</source>
            <translation>Speichern unter</translation>
        </message>
        <message>
            <source>{name} has no backup yet. The first save makes one.</source>
            <translation>{name} hat noch keine Sicherung. Das erste Speichern legt eine an.</translation>
        </message>
        <message>
            <source> Your unsaved changes will be lost.</source>
            <translation> Die ungespeicherten Änderungen gehen verloren.</translation>
        </message>
        <message>
            <source>Replace {name} by its backup? The present content becomes the backup.{lost}</source>
            <translation>{name} durch die Sicherung ersetzen? Der jetzige Inhalt wird zur Sicherung.{lost}</translation>
        </message>
        <message>
            <source>Recover backup</source>
            <translation>Sicherung zurückholen</translation>
        </message>
        <message>
            <source>Recovering</source>
            <translation>Wird zurückgeholt</translation>
        </message>
        <message>
            <source>Machine facts</source>
            <translation>Angaben zur Maschine</translation>
        </message>
    </context>
    <context>
        <name>FilterBar</name>
        <message>
            <source>Filters of the table</source>
            <translation>Filter der Tabelle</translation>
        </message>
        <message>
            <source>All</source>
            <translation>Alle</translation>
        </message>
        <message>
            <source>Every row of this list</source>
            <translation>Jede Zeile dieser Liste</translation>
        </message>
        <message>
            <source>More filters</source>
            <translation>Weitere Filter</translation>
        </message>
    </context>
    <context>
        <name>FindBox</name>
        <message>
            <source>Find a parameter, value, message or command</source>
            <translation>Parameter, Wert, Meldung oder Befehl finden</translation>
        </message>
        <message>
            <source>Find</source>
            <translation>Finden</translation>
        </message>
        <message>
            <source>Type a number, a name, a value or a message of the control; &gt; lists commands</source>
            <translation>Nummer, Name, Wert oder Meldung der Steuerung eingeben; &gt; zeigt Befehle</translation>
        </message>
        <message>
            <source>Find (Ctrl+K); &gt; commands (Ctrl+Shift+P)</source>
            <translation>Finden (Strg+K); &gt; Befehle (Strg+Umschalt+P)</translation>
        </message>
        <message>
            <source>Found</source>
            <translation>Gefunden</translation>
        </message>
        <message>
            <source>↑ ↓ choose    Enter go there    Esc close    &gt; commands</source>
            <translation>↑ ↓ wählen    Eingabe hingehen    Esc schließen    &gt; Befehle</translation>
        </message>
        <message numerus="yes">
            <source>%n found</source>
            <translation>
                <numerusform>%n gefunden</numerusform>
                <numerusform>%n gefunden</numerusform>
            </translation>
        </message>
        <message>
            <source>Ctrl K</source>
            <translation>Strg K</translation>
        </message>
    </context>
    <context>
        <name>FindSearch</name>
        <message>
            <source>Find</source>
            <translation>Finden</translation>
        </message>
    </context>
    <context>
        <name>FindingList</name>
        <message>
            <source>New findings in the result</source>
            <translation>Neue Befunde im Ergebnis</translation>
        </message>
    </context>
    <context>
        <name>FindingsDelegate</name>
        <message>
            <source>Why</source>
            <translation>Warum</translation>
        </message>
        <message>
            <source>Go to</source>
            <translation>Gehe zu</translation>
        </message>
    </context>
    <context>
        <name>FindingsPanel</name>
        <message>
            <source>Group</source>
            <translation>Gruppe</translation>
        </message>
        <message>
            <source>Findings</source>
            <translation>Befunde</translation>
        </message>
        <message>
            <source>Findings of</source>
            <translation>Befunde von</translation>
        </message>
        <message>
            <source>Fi&amp;x Several…</source>
            <translation>&amp;Mehrere beheben…</translation>
        </message>
        <message>
            <source>Open the findings</source>
            <translation>Befunde öffnen</translation>
        </message>
        <message>
            <source>Show the head of the findings alone</source>
            <translation>Nur den Kopf der Befunde zeigen</translation>
        </message>
        <message>
            <source>{number} active parameters are not set</source>
            <translation>{number} aktive Parameter sind nicht gesetzt</translation>
        </message>
        <message>
            <source>Axis {letter}</source>
            <translation>Achse {letter}</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>File</source>
            <translation>Datei</translation>
        </message>
        <message>
            <source>Findings of the parameters that the table shows</source>
            <translation>Befunde der Parameter, die die Tabelle zeigt</translation>
        </message>
        <message>
            <source>{message} Suppressed by {name}: {reason}</source>
            <translation>{message} Unterdrückt von {name}: {reason}</translation>
        </message>
        <message>
            <source>{count}; press to leave them out or list them again</source>
            <translation>{count}; drücken, um sie auszulassen oder wieder zu zeigen</translation>
        </message>
        <message>
            <source>{number} suppressed</source>
            <translation>{number} unterdrückt</translation>
        </message>
        <message numerus="yes">
            <source>{number} as delivered, to be set in steps {steps}</source>
            <translation>
                <numerusform>{number} wie ausgeliefert, zu setzen in Schritt {steps}</numerusform>
                <numerusform>{number} wie ausgeliefert, zu setzen in den Schritten {steps}</numerusform>
            </translation>
        </message>
        <message>
            <source>No findings with these filters.</source>
            <translation>Keine Befunde mit diesen Filtern.</translation>
        </message>
        <message>
            <source>No findings.</source>
            <translation>Keine Befunde.</translation>
        </message>
        <message>
            <source>{number} active parameters are not set.</source>
            <translation>{number} aktive Parameter sind nicht gesetzt.</translation>
        </message>
        <message>
            <source>&amp;Go to</source>
            <translation>&amp;Gehe zu</translation>
        </message>
        <message>
            <source>Enter</source>
            <translation>Eingabe</translation>
        </message>
        <message>
            <source>&amp;Why</source>
            <translation>&amp;Warum</translation>
        </message>
        <message>
            <source>Fi&amp;x</source>
            <translation>&amp;Beheben</translation>
        </message>
        <message>
            <source>&amp;Suppress…</source>
            <translation>&amp;Unterdrücken…</translation>
        </message>
    </context>
    <context>
        <name>FixSeveralDialog</name>
        <message>
            <source>Fix Several</source>
            <translation>Mehrere beheben</translation>
        </message>
        <message>
            <source>Suggested fixes</source>
            <translation>Vorgeschlagene Korrekturen</translation>
        </message>
        <message>
            <source>Checked at first: fixes that cannot change motion. All of them are one step of Undo.</source>
            <translation>Anfangs angekreuzt: Korrekturen, die keine Bewegung ändern können. Alle zusammen sind ein Schritt zum Zurücknehmen.</translation>
        </message>
        <message>
            <source>Apply {number} &amp;Fixes</source>
            <translation>{number} &amp;Korrekturen anwenden</translation>
        </message>
    </context>
    <context>
        <name>GroupList</name>
        <message>
            <source>Parameter groups</source>
            <translation>Parametergruppen</translation>
        </message>
        <message>
            <source>All parameters</source>
            <translation>Alle Parameter</translation>
        </message>
        <message numerus="yes">
            <source>%n values not set</source>
            <translation>
                <numerusform>%n Wert nicht gesetzt</numerusform>
                <numerusform>%n Werte nicht gesetzt</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>HandSheet</name>
        <message>
            <source>&amp;Values</source>
            <translation>&amp;Werte</translation>
        </message>
        <message>
            <source>&amp;Before and After</source>
            <translation>&amp;Vorher und nachher</translation>
        </message>
        <message>
            <source>&amp;Not on This Sheet</source>
            <translation>&amp;Nicht auf diesem Blatt</translation>
        </message>
        <message>
            <source>Against the &amp;Control</source>
            <translation>Gegen die &amp;Steuerung</translation>
        </message>
        <message>
            <source>Against a &amp;File…</source>
            <translation>Gegen eine &amp;Datei…</translation>
        </message>
        <message>
            <source>&amp;Update</source>
            <translation>&amp;Auffrischen</translation>
        </message>
        <message>
            <source>&amp;Save or Print…</source>
            <translation>&amp;Speichern oder drucken…</translation>
        </message>
        <message>
            <source>The sheet lists the values that differ from what the control contains. Where is that known from?</source>
            <translation>Das Blatt nennt die Werte, die anders sind als in der Steuerung. Woher ist bekannt, was sie enthält?</translation>
        </message>
        <message>
            <source>Values</source>
            <translation>Werte</translation>
        </message>
        <message>
            <source>Before</source>
            <translation>Vorher</translation>
        </message>
        <message>
            <source>After</source>
            <translation>Nachher</translation>
        </message>
        <message>
            <source>{done} of {total} keyed in</source>
            <translation>{done} von {total} eingegeben</translation>
        </message>
        <message>
            <source>{count} read back as they should be</source>
            <translation>{count} richtig zurückgelesen</translation>
        </message>
        <message>
            <source>{wrong} not as keyed in</source>
            <translation>{wrong} nicht wie eingegeben</translation>
        </message>
        <message>
            <source>{forgotten} ticks left out, whose values have changed since</source>
            <translation>{forgotten} Haken ausgelassen, deren Werte sich seitdem geändert haben</translation>
        </message>
        <message>
            <source>. Compared with {present}.</source>
            <translation>. Verglichen mit {present}.</translation>
        </message>
        <message>
            <source>{why} (page {page})</source>
            <translation>{why} (Seite {page})</translation>
        </message>
        <message>
            <source>The tick is not kept: {error}.</source>
            <translation>Der Haken wird nicht behalten: {error}.</translation>
        </message>
        <message>
            <source>The file has changed: update the sheet before you go on.</source>
            <translation>Die Datei hat sich geändert: das Blatt erst auffrischen.</translation>
        </message>
        <message>
            <source>Update</source>
            <translation>Aktualisieren</translation>
        </message>
        <message>
            <source>Printing</source>
            <translation>Wird gedruckt</translation>
        </message>
    </context>
    <context>
        <name>HandleFooter</name>
        <message>
            <source>Drag a handle, or go to it with Tab and use the arrow keys</source>
            <translation>Einen Griff ziehen, oder mit Tab hingehen und die Pfeiltasten nehmen</translation>
        </message>
        <message>
            <source>← → {step}, Shift 10</source>
            <translation>← → {step}, Umschalt 10</translation>
        </message>
        <message>
            <source>No default</source>
            <translation>Keine Vorgabe</translation>
        </message>
        <message>
            <source>Default {value}</source>
            <translation>Vorgabe {value}</translation>
        </message>
    </context>
    <context>
        <name>IdentifyDialog</name>
        <message>
            <source>Machine from a Record — {name}</source>
            <translation>Maschine aus einer Aufzeichnung – {name}</translation>
        </message>
        <message>
            <source>Measured and predicted torque</source>
            <translation>Gemessenes und berechnetes Drehmoment</translation>
        </message>
        <message>
            <source>only for A, Nm or N: 0.056 A</source>
            <translation>nur bei A, Nm oder N: 0,056 A</translation>
        </message>
        <message>
            <source>Torque of the record for 1 % of rated torque, or for 1 V of output</source>
            <translation>Drehmoment der Aufzeichnung für 1 % des Nennmoments oder für 1 V Ausgang</translation>
        </message>
        <message>
            <source>&amp;Use in Simulation</source>
            <translation>In der &amp;Simulation verwenden</translation>
        </message>
        <message>
            <source>&amp;Save Machine…</source>
            <translation>Maschine s&amp;peichern…</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>S&amp;cale</source>
            <translation>S&amp;kala</translation>
        </message>
        <message>
            <source>Reading the Record</source>
            <translation>Aufzeichnung wird gelesen</translation>
        </message>
        <message>
            <source>Acceleration for one unit of torque</source>
            <translation>Beschleunigung je Einheit Drehmoment</translation>
        </message>
        <message>
            <source>Viscous friction at 1000 mm/min</source>
            <translation>Viskose Reibung bei 1000 mm/min</translation>
        </message>
        <message>
            <source>Coulomb friction</source>
            <translation>Coulombsche Reibung</translation>
        </message>
        <message>
            <source>Gravity</source>
            <translation>Gewicht</translation>
        </message>
        <message>
            <source>{used} of {all}</source>
            <translation>{used} von {all}</translation>
        </message>
        <message>
            <source>Rows</source>
            <translation>Zeilen</translation>
        </message>
        <message>
            <source>Save Machine</source>
            <translation>Maschine speichern</translation>
        </message>
        <message>
            <source>Machine (*.yaml)</source>
            <translation>Maschine (*.yaml)</translation>
        </message>
        <message>
            <source>{path} written</source>
            <translation>{path} geschrieben</translation>
        </message>
    </context>
    <context>
        <name>KnownList</name>
        <message>
            <source>Controls</source>
            <translation>Steuerungen</translation>
        </message>
        <message>
            <source>Add a control by its address</source>
            <translation>Eine Steuerung mit ihrer Adresse hinzufügen</translation>
        </message>
        <message>
            <source>Address of a control</source>
            <translation>Adresse einer Steuerung</translation>
        </message>
        <message>
            <source>Several Controls</source>
            <translation>Mehrere Steuerungen</translation>
        </message>
    </context>
    <context>
        <name>LeftPanel</name>
        <message>
            <source>This file is in no project.</source>
            <translation>Diese Datei ist in keinem Projekt.</translation>
        </message>
        <message>
            <source>Left panel</source>
            <translation>Linkes Feld</translation>
        </message>
        <message>
            <source>Steps</source>
            <translation>Schritte</translation>
        </message>
        <message>
            <source>Groups</source>
            <translation>Gruppen</translation>
        </message>
        <message>
            <source>Project</source>
            <translation>Projekt</translation>
        </message>
    </context>
    <context>
        <name>LivePage</name>
        <message>
            <source>Live: {address}</source>
            <translation>Live: {address}</translation>
        </message>
        <message>
            <source>No readings yet.</source>
            <translation>Noch keine Werte.</translation>
        </message>
        <message>
            <source>Reads only: nothing is written to the control.</source>
            <translation>Liest nur: in die Steuerung wird nichts geschrieben.</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>Position</source>
            <translation>Position</translation>
        </message>
        <message>
            <source>Following error</source>
            <translation>Schleppfehler</translation>
        </message>
        <message>
            <source>Velocity</source>
            <translation>Geschwindigkeit</translation>
        </message>
        <message>
            <source>Status</source>
            <translation>Zustand</translation>
        </message>
        <message>
            <source>Axes of the control</source>
            <translation>Achsen der Steuerung</translation>
        </message>
        <message>
            <source>Faults of the control</source>
            <translation>Fehler der Steuerung</translation>
        </message>
        <message>
            <source>Axis whose following error is drawn</source>
            <translation>Achse, deren Schleppfehler gezeichnet wird</translation>
        </message>
        <message>
            <source>Following error over time, a dot for each reading</source>
            <translation>Schleppfehler über der Zeit, ein Punkt je Ablesung</translation>
        </message>
        <message>
            <source>&amp;Start</source>
            <translation>&amp;Starten</translation>
        </message>
        <message>
            <source>&amp;Close</source>
            <translation>Sch&amp;ließen</translation>
        </message>
        <message>
            <source>&amp;Stop</source>
            <translation>An&amp;halten</translation>
        </message>
        <message>
            <source>Stopped.</source>
            <translation>Angehalten.</translation>
        </message>
        <message>
            <source>No answer for 2 s: the figures below are the last ones.</source>
            <translation>Seit 2 s keine Antwort: die Werte darunter sind die letzten.</translation>
        </message>
        <message>
            <source>Stopped: the control has a fault.</source>
            <translation>Angehalten: die Steuerung hat einen Fehler.</translation>
        </message>
        <message>
            <source> (page {page})</source>
            <translation> (Seite {page})</translation>
        </message>
    </context>
    <context>
        <name>MachinePage</name>
        <message>
            <source>What the control does not know. An empty field takes what is assumed or given by parameters.</source>
            <translation>Was die Steuerung nicht kennt. Ein leeres Feld nimmt, was angenommen wird oder Parameter angeben.</translation>
        </message>
        <message>
            <source>From a Recor&amp;d…</source>
            <translation>Aus Auf&amp;zeichnung…</translation>
        </message>
        <message>
            <source>&amp;Open Machine…</source>
            <translation>Maschine ö&amp;ffnen…</translation>
        </message>
        <message>
            <source>Find inertia, friction and weight in a record of the drive (CSV)</source>
            <translation>Trägheit, Reibung und Gewicht in einer Aufzeichnung des Antriebs finden (CSV)</translation>
        </message>
        <message>
            <source>Take the figures of a machine file (YAML)</source>
            <translation>Die Werte einer Maschinendatei übernehmen (YAML)</translation>
        </message>
        <message>
            <source>Record of a Drive</source>
            <translation>Aufzeichnung eines Antriebs</translation>
        </message>
        <message>
            <source>Records (*.csv *.txt);;All files (*)</source>
            <translation>Aufzeichnungen (*.csv *.txt);;Alle Dateien (*)</translation>
        </message>
        <message>
            <source>Machine</source>
            <translation>Maschine</translation>
        </message>
        <message>
            <source>Machine (*.yaml)</source>
            <translation>Maschine (*.yaml)</translation>
        </message>
    </context>
    <context>
        <name>MachinesDialog</name>
        <message>
            <source>Compare Machines</source>
            <translation>Maschinen vergleichen</translation>
        </message>
        <message>
            <source>Machines</source>
            <translation>Maschinen</translation>
        </message>
        <message>
            <source>&amp;Add Files…</source>
            <translation>Dateien &amp;hinzufügen…</translation>
        </message>
        <message>
            <source>Filter by number, name, axis or value</source>
            <translation>Nach Nummer, Name, Achse oder Wert filtern</translation>
        </message>
        <message>
            <source>Filter</source>
            <translation>Filtern</translation>
        </message>
        <message>
            <source>Also what is the &amp;same</source>
            <translation>Auch was &amp;gleich ist</translation>
        </message>
        <message>
            <source>Axes by &amp;letter</source>
            <translation>Achsen nach &amp;Buchstaben</translation>
        </message>
        <message>
            <source>Compare the axes that have the same letter, not the same number</source>
            <translation>Die Achsen mit demselben Buchstaben vergleichen, nicht die mit derselben Nummer</translation>
        </message>
        <message>
            <source>&amp;Export…</source>
            <translation>E&amp;xportieren…</translation>
        </message>
        <message>
            <source>&amp;Close</source>
            <translation>Sch&amp;ließen</translation>
        </message>
        <message>
            <source>Values of the machines</source>
            <translation>Werte der Maschinen</translation>
        </message>
        <message>
            <source>Reading the files</source>
            <translation>Die Dateien werden gelesen</translation>
        </message>
        <message>
            <source>{name} (cannot be read)</source>
            <translation>{name} (nicht lesbar)</translation>
        </message>
        <message>
            <source>Add files</source>
            <translation>Dateien hinzufügen</translation>
        </message>
        <message>
            <source>Choose two machines or more.</source>
            <translation>Zwei oder mehr Maschinen wählen.</translation>
        </message>
        <message>
            <source>Comparing</source>
            <translation>Wird verglichen</translation>
        </message>
        <message>
            <source>Nothing differs.</source>
            <translation>Nichts ist verschieden.</translation>
        </message>
        <message>
            <source>Different: {differ}; the same: {same}</source>
            <translation>Verschieden: {differ}; gleich: {same}</translation>
        </message>
        <message>
            <source>; shown: {count}</source>
            <translation>; gezeigt: {count}</translation>
        </message>
        <message>
            <source>Export</source>
            <translation>Exportieren</translation>
        </message>
        <message>
            <source>{path} written</source>
            <translation>{path} geschrieben</translation>
        </message>
    </context>
    <context>
        <name>MachinesModel</name>
        <message>
            <source>, unlike most</source>
            <translation>, anders als die meisten</translation>
        </message>
    </context>
    <context>
        <name>MainToolBar</name>
        <message>
            <source>Main</source>
            <translation>Hauptleiste</translation>
        </message>
        <message>
            <source>Unit system</source>
            <translation>Einheitensystem</translation>
        </message>
        <message>
            <source>inch</source>
            <translation>Zoll</translation>
        </message>
    </context>
    <context>
        <name>MainWindow</name>
        <message>
            <source>Calculator</source>
            <translation>Rechner</translation>
        </message>
        <message>
            <source>Fix Several</source>
            <translation>Mehrere beheben</translation>
        </message>
        <message>
            <source>Fill</source>
            <translation>Füllen</translation>
        </message>
        <message>
            <source>Explain</source>
            <translation>Erklären</translation>
        </message>
        <message>
            <source>Suppress</source>
            <translation>Unterdrücken</translation>
        </message>
        <message>
            <source>Fix</source>
            <translation>Beheben</translation>
        </message>
        <message>
            <source>Sending</source>
            <translation>Senden</translation>
        </message>
        <message>
            <source>Values are being sent to a control. Closing stops at the next safe point.</source>
            <translation>Werte werden an eine Steuerung gesendet. Schließen hält am nächsten sicheren Punkt an.</translation>
        </message>
        <message>
            <source>&amp;Stop and Close</source>
            <translation>&amp;Anhalten und schließen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>Open</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>Open {name}</source>
            <translation>{name} öffnen</translation>
        </message>
    </context>
    <context>
        <name>MaskList</name>
        <message>
            <source>Bits</source>
            <translation>Bits</translation>
        </message>
        <message>
            <source>{label}   bit {number}</source>
            <translation>{label}   Bit {number}</translation>
        </message>
        <message>
            <source>{count} of {bits} bits set</source>
            <translation>{count} von {bits} Bits gesetzt</translation>
        </message>
        <message>
            <source>hex {hex}, decimal {number}</source>
            <translation>hex {hex}, dezimal {number}</translation>
        </message>
    </context>
    <context>
        <name>MeasuredDialog</name>
        <message>
            <source>Measured Points — {name}</source>
            <translation>Messpunkte — {name}</translation>
        </message>
        <message>
            <source>Notes</source>
            <translation>Notizen</translation>
        </message>
        <message>
            <source>Mean errors as measured and as expected</source>
            <translation>Mittlere Fehler, gemessen und erwartet</translation>
        </message>
        <message>
            <source>&amp;Set Values</source>
            <translation>Werte &amp;setzen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>as the file names it</source>
            <translation>wie die Datei es nennt</translation>
        </message>
        <message>
            <source>measured less target (ISO 230-2)</source>
            <translation>gemessen minus Soll (ISO 230-2)</translation>
        </message>
        <message>
            <source>target less measured (correction)</source>
            <translation>Soll minus gemessen (Korrektur)</translation>
        </message>
        <message>
            <source>point</source>
            <translation>Punkt</translation>
        </message>
        <message>
            <source>comma</source>
            <translation>Komma</translation>
        </message>
        <message>
            <source>choose…</source>
            <translation>wählen…</translation>
        </message>
        <message>
            <source>off</source>
            <translation>aus</translation>
        </message>
        <message>
            <source>on: points are what is left over</source>
            <translation>ein: Punkte sind der Rest</translation>
        </message>
        <message>
            <source>the first one: it turns round at 0° and 180°</source>
            <translation>die erste: sie kehrt bei 0° und 180° um</translation>
        </message>
        <message>
            <source>the second one: at 90° and 270°</source>
            <translation>die zweite: bei 90° und 270°</translation>
        </message>
        <message>
            <source>deviation</source>
            <translation>Abweichung</translation>
        </message>
        <message>
            <source>measured position</source>
            <translation>gemessene Position</translation>
        </message>
        <message>
            <source>most negative position</source>
            <translation>negativste Position</translation>
        </message>
        <message>
            <source>most positive position</source>
            <translation>positivste Position</translation>
        </message>
        <message>
            <source>Calibration &amp;table</source>
            <translation>Kalibrier&amp;tabelle</translation>
        </message>
        <message>
            <source>&amp;Reversal error</source>
            <translation>&amp;Umkehrspanne</translation>
        </message>
        <message>
            <source>&amp;Positions in</source>
            <translation>&amp;Positionen in</translation>
        </message>
        <message>
            <source>&amp;Errors in</source>
            <translation>&amp;Fehler in</translation>
        </message>
        <message>
            <source>An error &amp;is</source>
            <translation>Ein Fehler &amp;ist</translation>
        </message>
        <message>
            <source>&amp;Decimal sign</source>
            <translation>&amp;Dezimalzeichen</translation>
        </message>
        <message>
            <source>&amp;Compensation was</source>
            <translation>&amp;Kompensation war</translation>
        </message>
        <message>
            <source>A&amp;xis of the circle</source>
            <translation>&amp;Achse des Kreises</translation>
        </message>
        <message>
            <source>&amp;Figures are</source>
            <translation>&amp;Zahlen sind</translation>
        </message>
        <message>
            <source>Table starts &amp;at the</source>
            <translation>Tabelle beginnt an &amp;der</translation>
        </message>
        <message>
            <source>Set</source>
            <translation>Setzen</translation>
        </message>
        <message>
            <source>Working out</source>
            <translation>Wird berechnet</translation>
        </message>
        <message>
            <source>the unit of the positions</source>
            <translation>die Einheit der Positionen</translation>
        </message>
        <message>
            <source>the unit of the errors</source>
            <translation>die Einheit der Fehler</translation>
        </message>
        <message>
            <source>what an error is</source>
            <translation>was ein Fehler ist</translation>
        </message>
        <message>
            <source>The file does not name {what}: choose it.</source>
            <translation>Die Datei nennt {what} nicht: auswählen.</translation>
        </message>
        <message>
            <source>rising</source>
            <translation>steigend</translation>
        </message>
        <message>
            <source>falling</source>
            <translation>fallend</translation>
        </message>
        <message>
            <source>{side} as measured</source>
            <translation>{side} gemessen</translation>
        </message>
        <message>
            <source>{side} expected</source>
            <translation>{side} erwartet</translation>
        </message>
        <message numerus="yes">
            <source>Circles of a ball-bar: %n</source>
            <translation>
                <numerusform>Kreise eines Kreisformtesters: %n</numerusform>
                <numerusform>Kreise eines Kreisformtesters: %n</numerusform>
            </translation>
        </message>
        <message>
            <source>Read as {error_unit}, {sign}</source>
            <translation>Gelesen als {error_unit}, {sign}</translation>
        </message>
        <message>
            <source>{count} targets, {up} runs rising, {down} falling</source>
            <translation>{count} Sollpositionen, {up} Läufe steigend, {down} fallend</translation>
        </message>
        <message>
            <source>Read as {unit} and {error_unit}, {sign}</source>
            <translation>Gelesen als {unit} und {error_unit}, {sign}</translation>
        </message>
        <message>
            <source>Accuracy A</source>
            <translation>Genauigkeit A</translation>
        </message>
        <message>
            <source>Repeatability R</source>
            <translation>Wiederholgenauigkeit R</translation>
        </message>
        <message>
            <source>Reversal value B</source>
            <translation>Umkehrspanne B</translation>
        </message>
        <message>
            <source>Systematic deviation E</source>
            <translation>Systematische Abweichung E</translation>
        </message>
        <message>
            <source>Range of mean errors M</source>
            <translation>Spanne der mittleren Fehler M</translation>
        </message>
        <message>
            <source>Error {before:.5f} {unit} measured, {after:.5f} {unit} expected</source>
            <translation>Fehler {before:.5f} {unit} gemessen, {after:.5f} {unit} erwartet</translation>
        </message>
        <message>
            <source>{count} points</source>
            <translation>{count} Punkte</translation>
        </message>
        <message>
            <source>Nothing would be set.</source>
            <translation>Nichts würde gesetzt.</translation>
        </message>
    </context>
    <context>
        <name>MergeDelegate</name>
        <message>
            <source>Take all</source>
            <translation>Alle nehmen</translation>
        </message>
        <message>
            <source>Both changed: choose</source>
            <translation>Beide geändert: wählen</translation>
        </message>
        <message>
            <source>typed</source>
            <translation>eingegeben</translation>
        </message>
        <message>
            <source>conflict settled</source>
            <translation>Konflikt gelöst</translation>
        </message>
        <message>
            <source>typed, conflict settled</source>
            <translation>eingegeben, Konflikt gelöst</translation>
        </message>
        <message>
            <source>unit follows the axis</source>
            <translation>Einheit folgt der Achse</translation>
        </message>
        <message>
            <source>Result</source>
            <translation>Ergebnis</translation>
        </message>
    </context>
    <context>
        <name>MergeDetail</name>
        <message>
            <source>Selected value</source>
            <translation>Ausgewählter Wert</translation>
        </message>
        <message>
            <source>&amp;Other</source>
            <translation>&amp;Anderer</translation>
        </message>
        <message>
            <source>Other value</source>
            <translation>Anderer Wert</translation>
        </message>
        <message>
            <source>Keys: 0, A, B take a source, F2 types a value, C goes to the next conflict.</source>
            <translation>Tasten: 0, A, B nehmen eine Quelle, F2 gibt einen Wert ein, C geht zum nächsten Konflikt.</translation>
        </message>
        <message>
            <source>no finding</source>
            <translation>kein Befund</translation>
        </message>
        <message>
            <source>The same in all sources.</source>
            <translation>In allen Quellen gleich.</translation>
        </message>
        <message>
            <source>Both sides changed it to the same.</source>
            <translation>Beide Seiten haben es gleich geändert.</translation>
        </message>
        <message>
            <source>Both sides changed it, and not to the same.</source>
            <translation>Beide Seiten haben es geändert, und nicht gleich.</translation>
        </message>
        <message>
            <source>The sources differ.</source>
            <translation>Die Quellen unterscheiden sich.</translation>
        </message>
        <message>
            <source>Set in {side} only.</source>
            <translation>Nur in {side} gesetzt.</translation>
        </message>
        <message>
            <source>Only {side} changed it.</source>
            <translation>Nur {side} hat es geändert.</translation>
        </message>
        <message>
            <source>Takes effect</source>
            <translation>Wirkt</translation>
        </message>
        <message>
            <source>Page</source>
            <translation>Seite</translation>
        </message>
        <message>
            <source>Here</source>
            <translation>Hier</translation>
        </message>
        <message>
            <source>not on this machine type</source>
            <translation>nicht bei diesem Maschinentyp</translation>
        </message>
        <message>
            <source>Inactive</source>
            <translation>Inaktiv</translation>
        </message>
    </context>
    <context>
        <name>MergeHeader</name>
        <message>
            <source>Result</source>
            <translation>Ergebnis</translation>
        </message>
    </context>
    <context>
        <name>MergeModel</name>
        <message>
            <source>Application</source>
            <translation>Anwendung</translation>
        </message>
        <message>
            <source>Control software revision</source>
            <translation>Softwarestand der Steuerung</translation>
        </message>
        <message>
            <source>Notes</source>
            <translation>Notizen</translation>
        </message>
        <message>
            <source>Machine type</source>
            <translation>Maschinentyp</translation>
        </message>
        <message>
            <source>Note on {parameter}</source>
            <translation>Notiz zu {parameter}</translation>
        </message>
        <message>
            <source>Step {step} ticked as done</source>
            <translation>Schritt {step} als erledigt abgehakt</translation>
        </message>
        <message>
            <source>The text contains a character that no file can contain.</source>
            <translation>Der Text enthält ein Zeichen, das keine Datei enthalten kann.</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>Result</source>
            <translation>Ergebnis</translation>
        </message>
        <message>
            <source>Both changed: choose</source>
            <translation>Beide geändert: wählen</translation>
        </message>
        <message>
            <source>Machine facts</source>
            <translation>Angaben zur Maschine</translation>
        </message>
        <message>
            <source>Notes and ticks</source>
            <translation>Notizen und Haken</translation>
        </message>
        <message>
            <source>Entries that this family does not know</source>
            <translation>Einträge, die diese Familie nicht kennt</translation>
        </message>
        <message numerus="yes">
            <source>%n differ</source>
            <translation>
                <numerusform>%n unterscheidet sich</numerusform>
                <numerusform>%n unterscheiden sich</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>conflicts: %n</source>
            <translation>
                <numerusform>Konflikte: %n</numerusform>
                <numerusform>Konflikte: %n</numerusform>
            </translation>
        </message>
        <message>
            <source>base</source>
            <translation>Basis</translation>
        </message>
    </context>
    <context>
        <name>MergeSources</name>
        <message numerus="yes">
            <source>this file, unsaved changes: %n</source>
            <translation>
                <numerusform>diese Datei, ungespeicherte Änderungen: %n</numerusform>
                <numerusform>diese Datei, ungespeicherte Änderungen: %n</numerusform>
            </translation>
        </message>
        <message>
            <source>this file</source>
            <translation>diese Datei</translation>
        </message>
        <message>
            <source>Last saved</source>
            <translation>Zuletzt gespeichert</translation>
        </message>
        <message>
            <source>When opened</source>
            <translation>Beim Öffnen</translation>
        </message>
        <message>
            <source>On disk</source>
            <translation>Auf der Platte</translation>
        </message>
        <message>
            <source>Backup</source>
            <translation>Sicherung</translation>
        </message>
        <message>
            <source>Defaults</source>
            <translation>Vorgaben</translation>
        </message>
        <message>
            <source>as the manual prints them</source>
            <translation>wie das Handbuch sie druckt</translation>
        </message>
        <message>
            <source>Before {time}</source>
            <translation>Vor {time}</translation>
        </message>
        <message>
            <source>Axis {source}</source>
            <translation>Achse {source}</translation>
        </message>
        <message>
            <source>in the place of axis {target}</source>
            <translation>an Stelle der Achse {target}</translation>
        </message>
        <message>
            <source>Axis {letter} is axis {number} in {file}; it is compared with axis {place} here.</source>
            <translation>Achse {letter} ist in {file} Achse {number}; sie wird hier mit Achse {place} verglichen.</translation>
        </message>
        <message>
            <source>Only {file} has the axes {letters}, and there is no free axis for them here.</source>
            <translation>Nur {file} hat die Achsen {letters}, und hier ist keine Achse dafür frei.</translation>
        </message>
        <message>
            <source>{file} is for another machine type ({machine}).</source>
            <translation>{file} ist für einen anderen Maschinentyp ({machine}).</translation>
        </message>
        <message>
            <source>Last download</source>
            <translation>Letzte Sendung</translation>
        </message>
        <message>
            <source>{file} cannot be shown: {why}</source>
            <translation>{file} kann nicht gezeigt werden: {why}</translation>
        </message>
        <message>
            <source>Kept copy</source>
            <translation>Behaltene Kopie</translation>
        </message>
        <message>
            <source>read from the control at {time}</source>
            <translation>aus der Steuerung gelesen um {time}</translation>
        </message>
        <message>
            <source>{file} is for {other} and {this} is for {family}: only files of one family can be compared.</source>
            <translation>{file} ist für {other} und {this} für {family}: nur Dateien einer Familie lassen sich vergleichen.</translation>
        </message>
        <message>
            <source>This File</source>
            <translation>Diese Datei</translation>
        </message>
        <message>
            <source>Other Files</source>
            <translation>Andere Dateien</translation>
        </message>
        <message>
            <source>Another &amp;File…</source>
            <translation>Andere &amp;Datei…</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>&amp;Control Now…</source>
            <translation>&amp;Steuerung jetzt…</translation>
        </message>
        <message>
            <source>Last Do&amp;wnload</source>
            <translation>Letzte &amp;Sendung</translation>
        </message>
        <message>
            <source>&amp;Kept Copies</source>
            <translation>Behaltene &amp;Kopien</translation>
        </message>
        <message>
            <source>Another &amp;Copy…</source>
            <translation>&amp;Andere Kopie…</translation>
        </message>
        <message>
            <source>&amp;Now, With Unsaved Changes</source>
            <translation>&amp;Jetzt, mit ungespeicherten Änderungen</translation>
        </message>
        <message>
            <source>As Last &amp;Saved</source>
            <translation>Wie zuletzt &amp;gespeichert</translation>
        </message>
        <message>
            <source>As &amp;Opened</source>
            <translation>Wie ge&amp;öffnet</translation>
        </message>
        <message>
            <source>On &amp;Disk</source>
            <translation>Auf der &amp;Platte</translation>
        </message>
        <message>
            <source>&amp;Backup</source>
            <translation>Si&amp;cherung</translation>
        </message>
        <message>
            <source>Before {time}, {who}</source>
            <translation>Vor {time}, {who}</translation>
        </message>
        <message>
            <source>&amp;Earlier Saves</source>
            <translation>&amp;Frühere Stände</translation>
        </message>
        <message>
            <source>Default &amp;Values</source>
            <translation>&amp;Vorgaben</translation>
        </message>
        <message>
            <source>Another A&amp;xis</source>
            <translation>Andere Ac&amp;hse</translation>
        </message>
        <message>
            <source>In the Place of Axis {target}</source>
            <translation>An Stelle der Achse {target}</translation>
        </message>
        <message>
            <source>open in another tab</source>
            <translation>in einem anderen Reiter offen</translation>
        </message>
    </context>
    <context>
        <name>MergeTree</name>
        <message>
            <source>Differences</source>
            <translation>Unterschiede</translation>
        </message>
        <message>
            <source>Take Source &amp;0</source>
            <translation>Quelle &amp;0 nehmen</translation>
        </message>
        <message>
            <source>Take Source &amp;A</source>
            <translation>Quelle &amp;A nehmen</translation>
        </message>
        <message>
            <source>Take Source &amp;B</source>
            <translation>Quelle &amp;B nehmen</translation>
        </message>
        <message>
            <source>&amp;Type a Value</source>
            <translation>Wert &amp;eingeben</translation>
        </message>
        <message>
            <source>Take &amp;Back the Choice</source>
            <translation>Wahl zurücknehmen (&amp;W)</translation>
        </message>
        <message>
            <source>&amp;Next Difference</source>
            <translation>&amp;Nächster Unterschied</translation>
        </message>
        <message>
            <source>&amp;Previous Difference</source>
            <translation>&amp;Voriger Unterschied</translation>
        </message>
        <message>
            <source>Next &amp;Conflict</source>
            <translation>Nächster &amp;Konflikt</translation>
        </message>
        <message>
            <source>Pre&amp;vious Conflict</source>
            <translation>Voriger K&amp;onflikt</translation>
        </message>
        <message>
            <source>&amp;Show in the Table</source>
            <translation>In der Tabelle &amp;zeigen</translation>
        </message>
        <message>
            <source>Enter</source>
            <translation>Eingabe</translation>
        </message>
        <message>
            <source>Cop&amp;y Rows</source>
            <translation>Zeilen ko&amp;pieren</translation>
        </message>
    </context>
    <context>
        <name>MergeWindow</name>
        <message>
            <source>Compare and Merge: {file}</source>
            <translation>Vergleichen und zusammenführen: {file}</translation>
        </message>
        <message>
            <source>Stopping at the next safe point …</source>
            <translation>Hält an der nächsten sicheren Stelle an …</translation>
        </message>
        <message>
            <source>goes to {file}</source>
            <translation>geht nach {file}</translation>
        </message>
        <message>
            <source>{differ} differ, {same} the same</source>
            <translation>{differ} verschieden, {same} gleich</translation>
        </message>
        <message>
            <source>Conflicts</source>
            <translation>Konflikte</translation>
        </message>
        <message>
            <source>The result cannot be checked, and so not merged: {why}</source>
            <translation>Das Ergebnis kann nicht geprüft und so nicht zusammengeführt werden: {why}</translation>
        </message>
        <message numerus="yes">
            <source>&amp;Merge Anyway (New Errors: %n)</source>
            <translation>
                <numerusform>Trotzdem &amp;zusammenführen (neue Fehler: %n)</numerusform>
                <numerusform>Trotzdem &amp;zusammenführen (neue Fehler: %n)</numerusform>
            </translation>
        </message>
        <message>
            <source>&amp;Merge into {file}</source>
            <translation>In {file} &amp;zusammenführen</translation>
        </message>
        <message>
            <source>Settle every conflict first.</source>
            <translation>Erst jeden Konflikt lösen.</translation>
        </message>
        <message>
            <source>Neither A nor B is the open file: save the result as a new file.</source>
            <translation>Weder A noch B ist die offene Datei: das Ergebnis als neue Datei speichern.</translation>
        </message>
        <message>
            <source>The file is open read-only.</source>
            <translation>Die Datei ist schreibgeschützt offen.</translation>
        </message>
        <message>
            <source>Nothing has been taken yet.</source>
            <translation>Noch nichts wurde genommen.</translation>
        </message>
        <message>
            <source>The result is being checked.</source>
            <translation>Das Ergebnis wird geprüft.</translation>
        </message>
        <message>
            <source>Merge with {source}</source>
            <translation>Mit {source} zusammenführen</translation>
        </message>
    </context>
    <context>
        <name>MessageBar</name>
        <message>
            <source>Message</source>
            <translation>Meldung</translation>
        </message>
        <message>
            <source>Close this message (Escape)</source>
            <translation>Diese Meldung schließen (Esc)</translation>
        </message>
        <message>
            <source>Close message</source>
            <translation>Meldung schließen</translation>
        </message>
    </context>
    <context>
        <name>MessageWindow</name>
        <message>
            <source>Message of the control</source>
            <translation>Meldung der Steuerung</translation>
        </message>
        <message>
            <source>How to find the cause</source>
            <translation>Wie man die Ursache findet</translation>
        </message>
        <message>
            <source>What helps</source>
            <translation>Was hilft</translation>
        </message>
        <message>
            <source>Parameters to look at</source>
            <translation>Parameter zum Nachsehen</translation>
        </message>
        <message>
            <source>Rules that find it</source>
            <translation>Regeln, die es finden</translation>
        </message>
        <message>
            <source>Rules that are met here</source>
            <translation>Regeln, die hier erfüllt sind</translation>
        </message>
        <message>
            <source>In this file</source>
            <translation>In dieser Datei</translation>
        </message>
    </context>
    <context>
        <name>MoreColumns</name>
        <message>
            <source>Show {column}</source>
            <translation>{column} zeigen</translation>
        </message>
    </context>
    <context>
        <name>MotionView</name>
        <message>
            <source>Motion — {name}</source>
            <translation>Bewegung — {name}</translation>
        </message>
        <message>
            <source>&amp;Run</source>
            <translation>&amp;Starten</translation>
        </message>
        <message>
            <source>&amp;Save…</source>
            <translation>S&amp;peichern…</translation>
        </message>
        <message>
            <source>&amp;Zoom to Settling</source>
            <translation>Auf das &amp;Einschwingen</translation>
        </message>
        <message>
            <source>Show &amp;All</source>
            <translation>&amp;Alles zeigen</translation>
        </message>
        <message>
            <source>&amp;Before</source>
            <translation>&amp;Vorher</translation>
        </message>
        <message>
            <source>&amp;Keep as Before</source>
            <translation>Als &amp;Vorher behalten</translation>
        </message>
        <message>
            <source>Draw the trace from before the changes under the present one</source>
            <translation>Die Kurve vor den Änderungen unter die jetzige zeichnen</translation>
        </message>
        <message>
            <source>Compare with the present trace from now on</source>
            <translation>Von nun an mit der jetzigen Kurve vergleichen</translation>
        </message>
        <message>
            <source>Simulated motion</source>
            <translation>Simulierte Bewegung</translation>
        </message>
        <message>
            <source>Figures of the motion</source>
            <translation>Zahlen der Bewegung</translation>
        </message>
        <message>
            <source>S&amp;cenario</source>
            <translation>&amp;Szenario</translation>
        </message>
        <message>
            <source>A&amp;xis</source>
            <translation>A&amp;chse</translation>
        </message>
        <message>
            <source>Figures</source>
            <translation>Zahlen</translation>
        </message>
        <message>
            <source>Recommended</source>
            <translation>Empfohlen</translation>
        </message>
        <message>
            <source>Assumed</source>
            <translation>Angenommen</translation>
        </message>
        <message>
            <source>Machine</source>
            <translation>Maschine</translation>
        </message>
        <message>
            <source>Cursors</source>
            <translation>Marken</translation>
        </message>
        <message>
            <source>Simulating …</source>
            <translation>Wird simuliert …</translation>
        </message>
        <message numerus="yes">
            <source>Figures of the machine that are assumed: &lt;b&gt;%n&lt;/b&gt;, see Assumed.</source>
            <translation>
                <numerusform>&lt;b&gt;%n Zahl der Maschine ist angenommen&lt;/b&gt;, siehe Angenommen.</numerusform>
                <numerusform>&lt;b&gt;%n Zahlen der Maschine sind angenommen&lt;/b&gt;, siehe Angenommen.</numerusform>
            </translation>
        </message>
        <message>
            <source>Recommended ({count})</source>
            <translation>Empfohlen ({count})</translation>
        </message>
        <message>
            <source>{what}, assumed</source>
            <translation>{what}, angenommen</translation>
        </message>
        <message>
            <source>Apply Recommendation</source>
            <translation>Empfehlung anwenden</translation>
        </message>
        <message>
            <source>Save</source>
            <translation>Speichern</translation>
        </message>
    </context>
    <context>
        <name>NewFileDialog</name>
        <message>
            <source>New parameter file</source>
            <translation>Neue Parameterdatei</translation>
        </message>
        <message>
            <source>Create &amp;File</source>
            <translation>&amp;Datei anlegen</translation>
        </message>
        <message>
            <source>&amp;Control</source>
            <translation>&amp;Steuerung</translation>
        </message>
        <message>
            <source>&amp;Machine type</source>
            <translation>&amp;Maschinentyp</translation>
        </message>
        <message>
            <source>&amp;Axes</source>
            <translation>&amp;Achsen</translation>
        </message>
        <message>
            <source>&amp;Units shown</source>
            <translation>&amp;Einheiten der Anzeige</translation>
        </message>
        <message>
            <source>&amp;Like</source>
            <translation>&amp;Wie</translation>
        </message>
        <message>
            <source>&amp;Name</source>
            <translation>&amp;Name</translation>
        </message>
        <message>
            <source>{family} has one system of units</source>
            <translation>{family} hat nur ein Einheitensystem</translation>
        </message>
        <message>
            <source>Metric (mm)</source>
            <translation>Metrisch (mm)</translation>
        </message>
        <message>
            <source>Inch</source>
            <translation>Zoll</translation>
        </message>
        <message>
            <source>The printed defaults</source>
            <translation>Die gedruckten Vorgaben</translation>
        </message>
        <message>
            <source>Example: {title}</source>
            <translation>Beispiel: {title}</translation>
        </message>
        <message>
            <source>Another file of mine…</source>
            <translation>Eine andere Datei von mir…</translation>
        </message>
        <message>
            <source>Like which file</source>
            <translation>Wie welche Datei</translation>
        </message>
        <message>
            <source>Machine type, axes and units are those of {name}. Not taken over: {own}.</source>
            <translation>Maschinentyp, Achsen und Einheiten sind die von {name}. Nicht übernommen: {own}.</translation>
        </message>
        <message>
            <source>{reason}.</source>
            <translation>{reason}.</translation>
        </message>
        <message>
            <source>Leave empty for the default axes</source>
            <translation>Leer lassen für die üblichen Achsen</translation>
        </message>
        <message>
            <source>For example X, Y, Z; offered are {letters}.</source>
            <translation>Zum Beispiel X, Y, Z; möglich sind {letters}.</translation>
        </message>
        <message>
            <source> X.2 is X of group 2.</source>
            <translation> X.2 ist X der Gruppe 2.</translation>
        </message>
        <message>
            <source> Written to {names}{page}.</source>
            <translation> Wird in {names} geschrieben{page}.</translation>
        </message>
        <message>
            <source>{file} is a file for {family}.</source>
            <translation>{file} ist eine Datei für {family}.</translation>
        </message>
        <message>
            <source>The project already has a file '{name}'. Choose another name.</source>
            <translation>Das Projekt hat schon eine Datei „{name}“. Einen anderen Namen wählen.</translation>
        </message>
        <message>
            <source>{file} in the project folder {folder}</source>
            <translation>{file} im Projektordner {folder}</translation>
        </message>
        <message>
            <source>{file}; the folder is asked for next</source>
            <translation>{file}; nach dem Ordner wird gleich gefragt</translation>
        </message>
        <message>
            <source>; axes {axes}</source>
            <translation>; Achsen {axes}</translation>
        </message>
    </context>
    <context>
        <name>NoteDialog</name>
        <message>
            <source>Note</source>
            <translation>Notiz</translation>
        </message>
        <message>
            <source>The whole machine</source>
            <translation>Die ganze Maschine</translation>
        </message>
        <message>
            <source>&amp;About</source>
            <translation>&amp;Über</translation>
        </message>
        <message>
            <source>&amp;Note</source>
            <translation>&amp;Notiz</translation>
        </message>
        <message>
            <source>&amp;Save Note</source>
            <translation>Notiz &amp;speichern</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>Note about {name}</source>
            <translation>Notiz zu {name}</translation>
        </message>
    </context>
    <context>
        <name>PageView</name>
        <message>
            <source>Pages of the report</source>
            <translation>Seiten des Berichts</translation>
        </message>
        <message>
            <source>Page {page} of {count}</source>
            <translation>Seite {page} von {count}</translation>
        </message>
    </context>
    <context>
        <name>ParameterTable</name>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>Axes</source>
            <translation>Achsen</translation>
        </message>
        <message>
            <source>Read by</source>
            <translation>Gelesen von</translation>
        </message>
    </context>
    <context>
        <name>PictureCanvas</name>
        <message>
            <source>Handle of the picture: arrow keys change the value, Shift by ten steps</source>
            <translation>Griff des Bildes: Pfeiltasten ändern den Wert, mit Umschalt um zehn Schritte</translation>
        </message>
        <message>
            <source>was {value}</source>
            <translation>war {value}</translation>
        </message>
        <message>
            <source>Move {name}</source>
            <translation>{name} verschieben</translation>
        </message>
        <message>
            <source>This point cannot be taken out: the table would have a gap</source>
            <translation>Dieser Punkt kann nicht heraus: die Tabelle hätte eine Lücke</translation>
        </message>
        <message>
            <source>The file is read-only</source>
            <translation>Die Datei ist schreibgeschützt</translation>
        </message>
        <message>
            <source>Dragging {name}: one undo step</source>
            <translation>{name} wird gezogen: ein Schritt zum Zurücknehmen</translation>
        </message>
        <message>
            <source>Put in a point</source>
            <translation>Einen Punkt einsetzen</translation>
        </message>
        <message>
            <source>Drag {name}</source>
            <translation>{name} ziehen</translation>
        </message>
    </context>
    <context>
        <name>PictureCard</name>
        <message>
            <source>Part of {name}</source>
            <translation>Teil von {name}</translation>
        </message>
        <message>
            <source>Show this picture alone</source>
            <translation>Nur dieses Bild zeigen</translation>
        </message>
        <message>
            <source>Show {name} alone</source>
            <translation>Nur {name} zeigen</translation>
        </message>
        <message numerus="yes">
            <source>%n more</source>
            <translation>
                <numerusform>%n weitere</numerusform>
                <numerusform>%n weitere</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>Pictures</name>
        <message>
            <source>The window is too small for that; the pictures are there once it is larger</source>
            <translation>Das Fenster ist dafür zu klein; die Bilder sind dort, sobald es größer ist</translation>
        </message>
        <message>
            <source>Save Picture</source>
            <translation>Bild speichern</translation>
        </message>
        <message>
            <source>{path} written</source>
            <translation>{path} geschrieben</translation>
        </message>
    </context>
    <context>
        <name>PicturesHead</name>
        <message>
            <source>Pictures</source>
            <translation>Bilder</translation>
        </message>
        <message>
            <source>Place of the pictures</source>
            <translation>Platz der Bilder</translation>
        </message>
        <message>
            <source>Pictures beside the table</source>
            <translation>Bilder neben der Tabelle</translation>
        </message>
        <message>
            <source>Pictures below the table</source>
            <translation>Bilder unter der Tabelle</translation>
        </message>
        <message>
            <source>Pictures instead of the table</source>
            <translation>Bilder statt der Tabelle</translation>
        </message>
        <message>
            <source>Close the pictures (F12)</source>
            <translation>Bilder schließen (F12)</translation>
        </message>
        <message>
            <source>Close the pictures</source>
            <translation>Bilder schließen</translation>
        </message>
    </context>
    <context>
        <name>PicturesPage</name>
        <message>
            <source>Pictures</source>
            <translation>Bilder</translation>
        </message>
        <message>
            <source>All</source>
            <translation>Alle</translation>
        </message>
        <message>
            <source>This family has no pictures.</source>
            <translation>Diese Familie hat keine Bilder.</translation>
        </message>
        <message>
            <source>Set {name}</source>
            <translation>{name} setzen</translation>
        </message>
    </context>
    <context>
        <name>PreviewHead</name>
        <message>
            <source>Report</source>
            <translation>Bericht</translation>
        </message>
        <message>
            <source>Page</source>
            <translation>Seite</translation>
        </message>
        <message>
            <source>Contents of the report</source>
            <translation>Inhalt des Berichts</translation>
        </message>
    </context>
    <context>
        <name>PreviewPanel</name>
        <message>
            <source>Report preview</source>
            <translation>Berichtsvorschau</translation>
        </message>
        <message>
            <source>Setting the pages …</source>
            <translation>Die Seiten werden gesetzt …</translation>
        </message>
        <message>
            <source>Open the &amp;Folder</source>
            <translation>&amp;Ordner öffnen</translation>
        </message>
        <message>
            <source>{name} is not in this report.</source>
            <translation>{name} steht nicht in diesem Bericht.</translation>
        </message>
    </context>
    <context>
        <name>ProgressDialog</name>
        <message>
            <source>No answer for {done} s</source>
            <translation>Keine Antwort seit {done} s</translation>
        </message>
        <message>
            <source>The line is cut</source>
            <translation>Die Leitung ist unterbrochen</translation>
        </message>
        <message>
            <source>
{why}, trying again …</source>
            <translation>
{why}, neuer Versuch …</translation>
        </message>
    </context>
    <context>
        <name>ProjectCheckDialog</name>
        <message>
            <source>Check All Files</source>
            <translation>Alle Dateien prüfen</translation>
        </message>
        <message>
            <source>{count} as saved on disk: {list}</source>
            <translation>{count} wie auf der Platte gespeichert: {list}</translation>
        </message>
        <message>
            <source>; {unread} cannot be read</source>
            <translation>; {unread} nicht lesbar</translation>
        </message>
        <message>
            <source>File</source>
            <translation>Datei</translation>
        </message>
        <message>
            <source>Errors</source>
            <translation>Fehler</translation>
        </message>
        <message>
            <source>Warnings</source>
            <translation>Warnungen</translation>
        </message>
        <message>
            <source>Recommendations</source>
            <translation>Empfehlungen</translation>
        </message>
        <message>
            <source>Finding</source>
            <translation>Befund</translation>
        </message>
        <message>
            <source>Findings of each file</source>
            <translation>Befunde jeder Datei</translation>
        </message>
    </context>
    <context>
        <name>ProjectDialog</name>
        <message>
            <source>Project information</source>
            <translation>Angaben zum Projekt</translation>
        </message>
        <message>
            <source>tcp://host:port or serial:/dev/ttyUSB0?baud=115200</source>
            <translation>tcp://host:port oder serial:/dev/ttyUSB0?baud=115200</translation>
        </message>
        <message>
            <source>On Windows, for example: serial:COM3?baud=115200</source>
            <translation>Unter Windows zum Beispiel: serial:COM3?baud=115200</translation>
        </message>
        <message>
            <source>&amp;Name</source>
            <translation>&amp;Name</translation>
        </message>
        <message>
            <source>Control &amp;family</source>
            <translation>Steuerungs&amp;familie</translation>
        </message>
        <message>
            <source>&amp;Machine type</source>
            <translation>&amp;Maschinentyp</translation>
        </message>
        <message>
            <source>Control &amp;address</source>
            <translation>&amp;Adresse der Steuerung</translation>
        </message>
        <message>
            <source>&amp;Control name</source>
            <translation>Name der &amp;Steuerung</translation>
        </message>
        <message>
            <source>Software &amp;revision</source>
            <translation>S&amp;oftwarestand</translation>
        </message>
        <message>
            <source>Save Pro&amp;ject</source>
            <translation>Pro&amp;jekt speichern</translation>
        </message>
        <message>
            <source>Create Pro&amp;ject</source>
            <translation>Pro&amp;jekt anlegen</translation>
        </message>
        <message>
            <source>Type a name for the project.</source>
            <translation>Einen Namen für das Projekt eingeben.</translation>
        </message>
    </context>
    <context>
        <name>ProjectFiles</name>
        <message>
            <source>The project {name} has no files yet.</source>
            <translation>Das Projekt {name} hat noch keine Dateien.</translation>
        </message>
        <message>
            <source>Check all files</source>
            <translation>Alle Dateien prüfen</translation>
        </message>
        <message>
            <source>Add a file</source>
            <translation>Eine Datei hinzufügen</translation>
        </message>
        <message>
            <source>{name} is in the folder already.</source>
            <translation>{name} ist schon im Ordner.</translation>
        </message>
        <message>
            <source>Copying</source>
            <translation>Kopieren</translation>
        </message>
        <message>
            <source>Move {name} to the trash? Its backup and the copies of controls stay.</source>
            <translation>{name} in den Papierkorb legen? Ihre Sicherung und die Kopien von Steuerungen bleiben.</translation>
        </message>
        <message>
            <source>Move {name} to the trash?</source>
            <translation>{name} in den Papierkorb legen?</translation>
        </message>
        <message>
            <source>&amp;Move to Trash</source>
            <translation>In den &amp;Papierkorb</translation>
        </message>
        <message>
            <source>Remove</source>
            <translation>Entfernen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>{name} is in the trash</source>
            <translation>{name} ist im Papierkorb</translation>
        </message>
        <message>
            <source>Only a file of a project is recovered: {name} is in none.</source>
            <translation>Nur eine Datei eines Projekts wird wiederhergestellt: {name} ist in keinem.</translation>
        </message>
    </context>
    <context>
        <name>ProjectTree</name>
        <message>
            <source>Project</source>
            <translation>Projekt</translation>
        </message>
        <message>
            <source>Add File…</source>
            <translation>Datei hinzufügen…</translation>
        </message>
        <message>
            <source>Check All</source>
            <translation>Alle prüfen</translation>
        </message>
        <message>
            <source>Own rules</source>
            <translation>Eigene Regeln</translation>
        </message>
        <message>
            <source>Notes and control</source>
            <translation>Notizen und Steuerung</translation>
        </message>
        <message>
            <source>deleted</source>
            <translation>gelöscht</translation>
        </message>
        <message>
            <source>Last {verb}: {control}, {when}</source>
            <translation>Zuletzt {verb}: {control}, {when}</translation>
        </message>
        <message>
            <source>Backup</source>
            <translation>Sicherung</translation>
        </message>
        <message>
            <source>Control before the download</source>
            <translation>Steuerung vor dem Senden</translation>
        </message>
        <message>
            <source>Recent projects</source>
            <translation>Letzte Projekte</translation>
        </message>
        <message>
            <source>open</source>
            <translation>offen</translation>
        </message>
        <message>
            <source>not saved</source>
            <translation>nicht gespeichert</translation>
        </message>
        <message>
            <source>cannot be read</source>
            <translation>nicht lesbar</translation>
        </message>
        <message>
            <source>Add file</source>
            <translation>Datei hinzufügen</translation>
        </message>
        <message>
            <source>Check all</source>
            <translation>Alle prüfen</translation>
        </message>
        <message>
            <source>Remove</source>
            <translation>Entfernen</translation>
        </message>
        <message>
            <source>Rec&amp;over</source>
            <translation>&amp;Wiederherstellen</translation>
        </message>
        <message>
            <source>&amp;Open</source>
            <translation>Ö&amp;ffnen</translation>
        </message>
        <message>
            <source>&amp;Compare With {file}</source>
            <translation>Mit {file} &amp;vergleichen</translation>
        </message>
        <message>
            <source>&amp;Move to the Trash…</source>
            <translation>In den &amp;Papierkorb…</translation>
        </message>
        <message>
            <source>&amp;Add File…</source>
            <translation>Datei &amp;hinzufügen…</translation>
        </message>
        <message>
            <source>Chec&amp;k All</source>
            <translation>Alle p&amp;rüfen</translation>
        </message>
        <message>
            <source>&amp;Show in the File Manager</source>
            <translation>Im &amp;Dateimanager zeigen</translation>
        </message>
    </context>
    <context>
        <name>QuickEdit</name>
        <message>
            <source>Quick Edit</source>
            <translation>Schnell nach Nummer</translation>
        </message>
        <message>
            <source>1300, or home.calibration@1</source>
            <translation>1300 oder home.calibration@1</translation>
        </message>
        <message>
            <source>Type a number and press Enter, then a value and press Enter. Escape closes.</source>
            <translation>Nummer und Eingabe, dann Wert und Eingabe. Esc schließt.</translation>
        </message>
        <message>
            <source>&amp;Number</source>
            <translation>&amp;Nummer</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>
Allowed here: {allowed}</source>
            <translation>
Hier erlaubt: {allowed}</translation>
        </message>
        <message>
            <source>&amp;Value</source>
            <translation>&amp;Wert</translation>
        </message>
        <message>
            <source>{what}: value set. Type the next number, or press Escape to close.</source>
            <translation>{what}: Wert gesetzt. Die nächste Nummer, oder Esc zum Schließen.</translation>
        </message>
    </context>
    <context>
        <name>RangeBar</name>
        <message>
            <source>Range</source>
            <translation>Bereich</translation>
        </message>
        <message>
            <source>rules allow {low} to {high}</source>
            <translation>Regeln erlauben {low} bis {high}</translation>
        </message>
        <message>
            <source>rules allow from {low}</source>
            <translation>Regeln erlauben ab {low}</translation>
        </message>
        <message>
            <source>rules allow up to {high}</source>
            <translation>Regeln erlauben bis {high}</translation>
        </message>
        <message>
            <source>{low} to {high} {unit}</source>
            <translation>{low} bis {high} {unit}</translation>
        </message>
        <message>
            <source>default {value}</source>
            <translation>Vorgabe {value}</translation>
        </message>
    </context>
    <context>
        <name>ReadingBar</name>
        <message>
            <source>Progress</source>
            <translation>Fortschritt</translation>
        </message>
        <message>
            <source>Cance&amp;l</source>
            <translation>A&amp;bbrechen</translation>
        </message>
        <message>
            <source>No answer, trying again …</source>
            <translation>Keine Antwort, neuer Versuch …</translation>
        </message>
        <message>
            <source>Reading …</source>
            <translation>Wird gelesen …</translation>
        </message>
    </context>
    <context>
        <name>RecentFiles</name>
        <message>
            <source>Open R&amp;ecent</source>
            <translation>Zule&amp;tzt offen</translation>
        </message>
        <message>
            <source>Open</source>
            <translation>Öffnen</translation>
        </message>
    </context>
    <context>
        <name>RecommendationsPage</name>
        <message>
            <source>Apply All {count}</source>
            <translation>Alle {count} anwenden</translation>
        </message>
        <message>
            <source>No recommendations.</source>
            <translation>Keine Empfehlungen.</translation>
        </message>
        <message>
            <source>Apply</source>
            <translation>Anwenden</translation>
        </message>
        <message>
            <source>Price: {price}</source>
            <translation>Preis: {price}</translation>
        </message>
    </context>
    <context>
        <name>RefusalFrame</name>
        <message>
            <source>Allowed: {range}</source>
            <translation>Erlaubt: {range}</translation>
        </message>
    </context>
    <context>
        <name>ReportDialog</name>
        <message>
            <source>Report</source>
            <translation>Bericht</translation>
        </message>
        <message>
            <source>O&amp;pen the report when it is written</source>
            <translation>Bericht danach ö&amp;ffnen</translation>
        </message>
        <message>
            <source>&amp;Browse…</source>
            <translation>&amp;Suchen…</translation>
        </message>
        <message>
            <source>The file extension sets the format: .pdf, .html, .xlsx, .csv, .json or .txt</source>
            <translation>Die Dateiendung bestimmt das Format: .pdf, .html, .xlsx, .csv, .json oder .txt</translation>
        </message>
        <message>
            <source>&amp;File</source>
            <translation>&amp;Datei</translation>
        </message>
        <message>
            <source>Pre&amp;view and Print…</source>
            <translation>&amp;Vorschau und drucken…</translation>
        </message>
        <message>
            <source>&amp;Write Report</source>
            <translation>Bericht schre&amp;iben</translation>
        </message>
    </context>
    <context>
        <name>ReportOptions</name>
        <message>
            <source>By group</source>
            <translation>Nach Gruppen</translation>
        </message>
        <message>
            <source>By parameter number</source>
            <translation>Nach Parameternummer</translation>
        </message>
        <message>
            <source>Axis and non-axis parameters</source>
            <translation>Parameter mit und ohne Achse</translation>
        </message>
        <message>
            <source>By step of commissioning</source>
            <translation>Nach Schritten der Inbetriebnahme</translation>
        </message>
        <message>
            <source>As in the file</source>
            <translation>Wie in der Datei</translation>
        </message>
        <message>
            <source>Metric</source>
            <translation>Metrisch</translation>
        </message>
        <message>
            <source>Inch</source>
            <translation>Zoll</translation>
        </message>
        <message>
            <source>Both, the other system's below</source>
            <translation>Beide, das andere System darunter</translation>
        </message>
        <message>
            <source>US Letter</source>
            <translation>US Letter</translation>
        </message>
        <message>
            <source>Only values that &amp;differ from the default</source>
            <translation>Nur &amp;abweichende Werte</translation>
        </message>
        <message>
            <source>Also what the control &amp;ignores on this machine</source>
            <translation>Auch was die Steuerung hier &amp;nicht beachtet</translation>
        </message>
        <message>
            <source>Pi&amp;ctures</source>
            <translation>&amp;Bilder</translation>
        </message>
        <message>
            <source>&amp;Motion, simulated</source>
            <translation>Bewe&amp;gung, simuliert</translation>
        </message>
        <message>
            <source>Part pro&amp;grams after power-up</source>
            <translation>Teilepro&amp;gramme nach dem Einschalten</translation>
        </message>
        <message>
            <source>E&amp;xchanges with controls</source>
            <translation>Aus&amp;tausch mit Steuerungen</translation>
        </message>
        <message>
            <source>&amp;Signatures</source>
            <translation>&amp;Unterschriften</translation>
        </message>
        <message>
            <source>&amp;Order</source>
            <translation>&amp;Reihenfolge</translation>
        </message>
        <message>
            <source>&amp;Units</source>
            <translation>&amp;Einheiten</translation>
        </message>
        <message>
            <source>&amp;Language</source>
            <translation>Sprac&amp;he</translation>
        </message>
        <message>
            <source>P&amp;aper</source>
            <translation>&amp;Papier</translation>
        </message>
        <message>
            <source>Chapters</source>
            <translation>Kapitel</translation>
        </message>
    </context>
    <context>
        <name>ReportPreview</name>
        <message>
            <source>Smaller (-)</source>
            <translation>Kleiner (-)</translation>
        </message>
        <message>
            <source>Larger (+)</source>
            <translation>Größer (+)</translation>
        </message>
        <message>
            <source>Fit the width (0)</source>
            <translation>Auf volle Breite (0)</translation>
        </message>
        <message>
            <source>Turn to the value that is selected in the table</source>
            <translation>Zu dem Wert blättern, der in der Tabelle gewählt ist</translation>
        </message>
        <message>
            <source>Export…</source>
            <translation>Exportieren…</translation>
        </message>
        <message>
            <source>Export</source>
            <translation>Exportieren</translation>
        </message>
        <message>
            <source>Print…</source>
            <translation>Drucken…</translation>
        </message>
        <message>
            <source>Print</source>
            <translation>Drucken</translation>
        </message>
        <message>
            <source>Close (Ctrl+5)</source>
            <translation>Schließen (Strg+5)</translation>
        </message>
    </context>
    <context>
        <name>ResultBar</name>
        <message>
            <source>&amp;Report…</source>
            <translation>&amp;Bericht…</translation>
        </message>
        <message>
            <source>Save Result A&amp;s…</source>
            <translation>&amp;Ergebnis speichern unter…</translation>
        </message>
        <message numerus="yes">
            <source>Changes so far: %n</source>
            <translation>
                <numerusform>Änderungen bisher: %n</numerusform>
                <numerusform>Änderungen bisher: %n</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>New errors: %n</source>
            <translation>
                <numerusform>Neue Fehler: %n</numerusform>
                <numerusform>Neue Fehler: %n</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>New warnings: %n</source>
            <translation>
                <numerusform>Neue Warnungen: %n</numerusform>
                <numerusform>Neue Warnungen: %n</numerusform>
            </translation>
        </message>
        <message>
            <source>Checking …</source>
            <translation>Wird geprüft …</translation>
        </message>
        <message>
            <source>No new finding</source>
            <translation>Kein neuer Befund</translation>
        </message>
    </context>
    <context>
        <name>RowHeads</name>
        <message>
            <source>Parameters</source>
            <translation>Parameter</translation>
        </message>
    </context>
    <context>
        <name>SettingsForm</name>
        <message>
            <source>empty:</source>
            <translation>leer:</translation>
        </message>
    </context>
    <context>
        <name>SeveralControls</name>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>Address</source>
            <translation>Adresse</translation>
        </message>
        <message>
            <source>Result</source>
            <translation>Ergebnis</translation>
        </message>
        <message>
            <source>How it ended</source>
            <translation>Wie es endete</translation>
        </message>
        <message>
            <source>Several controls</source>
            <translation>Mehrere Steuerungen</translation>
        </message>
        <message>
            <source>One after the other, and &amp;stop at the first failure</source>
            <translation>Nacheinander, beim ersten Fehlschlag &amp;anhalten</translation>
        </message>
        <message>
            <source>All parameters of each are replaced; what it contains is kept beside the file first</source>
            <translation>In jeder werden alle Parameter ersetzt; was sie enthält, wird vorher neben der Datei aufbewahrt</translation>
        </message>
        <message>
            <source>Save &amp;Table…</source>
            <translation>&amp;Tabelle speichern…</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>{name} has unsaved changes. A download sends the saved file.</source>
            <translation>{name} hat ungespeicherte Änderungen. Gesendet wird die gespeicherte Datei.</translation>
        </message>
        <message>
            <source>Save</source>
            <translation>Speichern</translation>
        </message>
        <message numerus="yes">
            <source>Send to %n Controls</source>
            <translation>
                <numerusform>An %n Steuerung senden</numerusform>
                <numerusform>An %n Steuerungen senden</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Compare With %n Controls</source>
            <translation>
                <numerusform>Mit %n Steuerung vergleichen</numerusform>
                <numerusform>Mit %n Steuerungen vergleichen</numerusform>
            </translation>
        </message>
        <message>
            <source>Tick the controls; “+” at the left adds one by its address.</source>
            <translation>Steuerungen anhaken; „+“ links fügt eine mit ihrer Adresse hinzu.</translation>
        </message>
        <message>
            <source>Waiting: the file is not saved</source>
            <translation>Wartet: die Datei ist nicht gesichert</translation>
        </message>
        <message>
            <source>Waiting: the file has errors</source>
            <translation>Wartet: die Datei hat Fehler</translation>
        </message>
        <message>
            <source>Waiting: what is replaced is not checked</source>
            <translation>Wartet: nicht bestätigt, dass ersetzt wird</translation>
        </message>
        <message>
            <source>{well} of {count} without a failure</source>
            <translation>{well} von {count} ohne Fehlschlag</translation>
        </message>
        <message>
            <source>Save table</source>
            <translation>Tabelle speichern</translation>
        </message>
        <message>
            <source>Controls</source>
            <translation>Steuerungen</translation>
        </message>
    </context>
    <context>
        <name>ShownValues</name>
        <message>
            <source> (page {page})</source>
            <translation> (Seite {page})</translation>
        </message>
    </context>
    <context>
        <name>SourceButton</name>
        <message>
            <source>Choose…</source>
            <translation>Wählen…</translation>
        </message>
        <message>
            <source>Source {letter}: {title}</source>
            <translation>Quelle {letter}: {title}</translation>
        </message>
    </context>
    <context>
        <name>StatusLine</name>
        <message>
            <source>Selected values</source>
            <translation>Ausgewählte Werte</translation>
        </message>
        <message>
            <source>File</source>
            <translation>Datei</translation>
        </message>
        <message>
            <source>Unsaved changes</source>
            <translation>Ungespeicherte Änderungen</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source>{number} not set</source>
            <translation>{number} nicht gesetzt</translation>
        </message>
        <message numerus="yes">
            <source>%n unsaved changes</source>
            <translation>
                <numerusform>%n ungespeicherte Änderung</numerusform>
                <numerusform>%n ungespeicherte Änderungen</numerusform>
            </translation>
        </message>
        <message>
            <source>as entered</source>
            <translation>wie eingegeben</translation>
        </message>
        <message numerus="yes">
            <source>%n axes</source>
            <translation>
                <numerusform>%n Achse</numerusform>
                <numerusform>%n Achsen</numerusform>
            </translation>
        </message>
        <message>
            <source>not saved</source>
            <translation>nicht gespeichert</translation>
        </message>
        <message>
            <source>saved</source>
            <translation>gespeichert</translation>
        </message>
        <message>
            <source>read-only</source>
            <translation>schreibgeschützt</translation>
        </message>
        <message>
            <source>{number} {noun}</source>
            <translation>{number} {noun}</translation>
        </message>
    </context>
    <context>
        <name>StepAnswer</name>
        <message>
            <source>Simulated axis</source>
            <translation>Simulierte Achse</translation>
        </message>
        <message>
            <source>Simulated answer to a step</source>
            <translation>Simulierte Sprungantwort</translation>
        </message>
        <message>
            <source>&amp;Keep as Before</source>
            <translation>Als &amp;Vorher behalten</translation>
        </message>
        <message>
            <source>Simulated ste&amp;p of axis</source>
            <translation>Simulierter &amp;Sprung der Achse</translation>
        </message>
        <message>
            <source>No axis of this file can be simulated.</source>
            <translation>Keine Achse dieser Datei kann simuliert werden.</translation>
        </message>
        <message>
            <source>Overshoot</source>
            <translation>Überschwingen</translation>
        </message>
        <message>
            <source>Settling time</source>
            <translation>Einschwingzeit</translation>
        </message>
        <message>
            <source>Peak following error</source>
            <translation>Größter Schleppfehler</translation>
        </message>
        <message>
            <source> (before {value:.4g})</source>
            <translation> (vorher {value:.4g})</translation>
        </message>
    </context>
    <context>
        <name>StepList</name>
        <message>
            <source>Steps: {name}</source>
            <translation>Schritte: {name}</translation>
        </message>
        <message>
            <source>As opened</source>
            <translation>Wie geöffnet</translation>
        </message>
        <message>
            <source>Steps</source>
            <translation>Schritte</translation>
        </message>
        <message>
            <source>Select a step to go back to it, or forward again.</source>
            <translation>Einen Schritt auswählen, um zu ihm zurück oder wieder vor zu gehen.</translation>
        </message>
    </context>
    <context>
        <name>StepsPanel</name>
        <message>
            <source>Steps of commissioning</source>
            <translation>Schritte der Inbetriebnahme</translation>
        </message>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source>Steps that are done</source>
            <translation>Erledigte Schritte</translation>
        </message>
        <message>
            <source> (page {page})</source>
            <translation> (Seite {page})</translation>
        </message>
        <message>
            <source>Part of the values that is set</source>
            <translation>Anteil der gesetzten Werte</translation>
        </message>
        <message>
            <source>Values that are set</source>
            <translation>Gesetzte Werte</translation>
        </message>
        <message>
            <source>Next Not Set  (Ctrl+.)</source>
            <translation>Nächster offener Wert  (Strg+.)</translation>
        </message>
        <message>
            <source>Print the check list</source>
            <translation>Checkliste drucken</translation>
        </message>
        <message>
            <source>Procedures</source>
            <translation>Abläufe</translation>
        </message>
        <message>
            <source>{title}, page {page}</source>
            <translation>{title}, Seite {page}</translation>
        </message>
        <message>
            <source>{done} of {needed} steps</source>
            <translation>{done} von {needed} Schritten</translation>
        </message>
        <message>
            <source>{set} of {total} set</source>
            <translation>{set} von {total} gesetzt</translation>
        </message>
        <message numerus="yes">
            <source>%n later findings held back</source>
            <translation>
                <numerusform>%n späterer Befund zurückgehalten</numerusform>
                <numerusform>%n spätere Befunde zurückgehalten</numerusform>
            </translation>
        </message>
        <message>
            <source>Hide</source>
            <translation>Ausblenden</translation>
        </message>
        <message>
            <source>Show</source>
            <translation>Zeigen</translation>
        </message>
        <message>
            <source>Show later findings</source>
            <translation>Spätere Befunde zeigen</translation>
        </message>
        <message numerus="yes">
            <source>%n values not set</source>
            <translation>
                <numerusform>%n Wert nicht gesetzt</numerusform>
                <numerusform>%n Werte nicht gesetzt</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n at the default</source>
            <translation>
                <numerusform>%n auf der Vorgabe</numerusform>
                <numerusform>%n auf der Vorgabe</numerusform>
            </translation>
        </message>
        <message>
            <source>ticked {when}</source>
            <translation>abgehakt {when}</translation>
        </message>
        <message>
            <source>not begun</source>
            <translation>nicht begonnen</translation>
        </message>
        <message>
            <source>begun</source>
            <translation>begonnen</translation>
        </message>
        <message>
            <source>done</source>
            <translation>erledigt</translation>
        </message>
        <message>
            <source>not needed on this machine</source>
            <translation>an dieser Maschine nicht nötig</translation>
        </message>
        <message>
            <source>{what}, not set</source>
            <translation>{what}, nicht gesetzt</translation>
        </message>
        <message>
            <source>Mark as Not &amp;Done</source>
            <translation>Als &amp;nicht erledigt</translation>
        </message>
        <message>
            <source>Mark as &amp;Done</source>
            <translation>Als &amp;erledigt</translation>
        </message>
        <message>
            <source>Keep De&amp;faults of This Step</source>
            <translation>&amp;Vorgaben dieses Schritts behalten</translation>
        </message>
        <message>
            <source>Step {number}</source>
            <translation>Schritt {number}</translation>
        </message>
    </context>
    <context>
        <name>StudioWindow</name>
        <message>
            <source>Saving</source>
            <translation>Speichern</translation>
        </message>
        <message>
            <source>Not saved</source>
            <translation>Nicht gespeichert</translation>
        </message>
        <message>
            <source>{error}.

Your work is still open.</source>
            <translation>{error}.

Die Arbeit ist noch offen.</translation>
        </message>
        <message>
            <source>Save the changes to {name}?</source>
            <translation>Die Änderungen an {name} speichern?</translation>
        </message>
        <message>
            <source>Unsaved changes</source>
            <translation>Ungespeicherte Änderungen</translation>
        </message>
        <message>
            <source>&amp;Save</source>
            <translation>&amp;Speichern</translation>
        </message>
        <message>
            <source>&amp;Discard</source>
            <translation>&amp;Verwerfen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
    </context>
    <context>
        <name>SuppressDialog</name>
        <message>
            <source>Suppress a Finding</source>
            <translation>Einen Befund unterdrücken</translation>
        </message>
        <message>
            <source>Also suppress the same finding of other parameters</source>
            <translation>Auch denselben Befund anderer Parameter unterdrücken</translation>
        </message>
        <message>
            <source>&amp;Suppress</source>
            <translation>&amp;Unterdrücken</translation>
        </message>
        <message>
            <source>&amp;Reason</source>
            <translation>&amp;Grund</translation>
        </message>
        <message>
            <source>&amp;Name</source>
            <translation>&amp;Name</translation>
        </message>
    </context>
    <context>
        <name>TabCorner</name>
        <message>
            <source>Open files</source>
            <translation>Offene Dateien</translation>
        </message>
    </context>
    <context>
        <name>TabEnd</name>
        <message>
            <source>Unsaved changes</source>
            <translation>Ungespeicherte Änderungen</translation>
        </message>
        <message>
            <source>Close (Ctrl+W)</source>
            <translation>Schließen (Strg+W)</translation>
        </message>
        <message>
            <source>Close</source>
            <translation>Schließen</translation>
        </message>
    </context>
    <context>
        <name>TablesDialog</name>
        <message>
            <source>Tables of the Manual</source>
            <translation>Tabellen des Handbuchs</translation>
        </message>
        <message>
            <source>Search all tables, for example an alarm, a motor or a number</source>
            <translation>Alle Tabellen durchsuchen, zum Beispiel nach Alarm, Motor oder Nummer</translation>
        </message>
        <message>
            <source>Search all tables</source>
            <translation>Alle Tabellen durchsuchen</translation>
        </message>
        <message>
            <source>Tables</source>
            <translation>Tabellen</translation>
        </message>
        <message>
            <source>Table</source>
            <translation>Tabelle</translation>
        </message>
        <message>
            <source>No table contains these words.</source>
            <translation>Keine Tabelle enthält diese Wörter.</translation>
        </message>
    </context>
    <context>
        <name>TextFormats</name>
        <message>
            <source>Import</source>
            <translation>Importieren</translation>
        </message>
        <message>
            <source>Text formats ({endings});;All files (*)</source>
            <translation>Textformate ({endings});;Alle Dateien (*)</translation>
        </message>
        <message>
            <source>&amp;Import</source>
            <translation>&amp;Importieren</translation>
        </message>
        <message>
            <source>Import as</source>
            <translation>Importieren als</translation>
        </message>
        <message>
            <source>Importing</source>
            <translation>Wird importiert</translation>
        </message>
        <message>
            <source>Listing:</source>
            <translation>Auflistung:</translation>
        </message>
        <message>
            <source>Machine type:</source>
            <translation>Maschinentyp:</translation>
        </message>
        <message>
            <source>Control family:</source>
            <translation>Steuerungsfamilie:</translation>
        </message>
        <message>
            <source>{error}.

Keep the lines that are not recognised, so that an export writes them back?
{listed}</source>
            <translation>{error}.

Die nicht erkannten Zeilen behalten, damit ein Export sie wieder schreibt?
{listed}</translation>
        </message>
        <message>
            <source>&amp;Keep Them</source>
            <translation>&amp;Behalten</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message>
            <source>
and {what} more</source>
            <translation>
und {what} weitere</translation>
        </message>
        <message>
            <source>One value is</source>
            <translation>Ein Wert ist</translation>
        </message>
        <message>
            <source>{count} values are</source>
            <translation>{count} Werte sind</translation>
        </message>
        <message>
            <source>{count} not allowed:
{listed}{more}

Import them and mark them as forced?</source>
            <translation>{count} nicht erlaubt:
{listed}{more}

Importieren und als erzwungen kennzeichnen?</translation>
        </message>
        <message>
            <source>&amp;Import and Mark</source>
            <translation>&amp;Importieren und kennzeichnen</translation>
        </message>
        <message>
            <source>Export</source>
            <translation>Exportieren</translation>
        </message>
        <message>
            <source>Exporting</source>
            <translation>Wird exportiert</translation>
        </message>
        <message>
            <source>&amp;Export</source>
            <translation>&amp;Exportieren</translation>
        </message>
        <message>
            <source>{written} of {total} values</source>
            <translation>{written} von {total} Werten</translation>
        </message>
        <message>
            <source>{name}: {written} of {total} values go across as they are.</source>
            <translation>{name}: {written} von {total} Werten kommen unverändert hinüber.</translation>
        </message>
    </context>
    <context>
        <name>TuningWindow</name>
        <message>
            <source>Tuning — {name}</source>
            <translation>Abgleich — {name}</translation>
        </message>
        <message>
            <source>What is tuned</source>
            <translation>Was abgeglichen wird</translation>
        </message>
        <message>
            <source>File</source>
            <translation>Datei</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>Do&amp;wnload Values</source>
            <translation>Werte &amp;senden</translation>
        </message>
        <message>
            <source>Read A&amp;gain</source>
            <translation>&amp;Neu lesen</translation>
        </message>
        <message>
            <source>Put Old Values &amp;Back</source>
            <translation>Alte Werte &amp;zurück</translation>
        </message>
        <message>
            <source>Take Into Fil&amp;e</source>
            <translation>In die &amp;Datei nehmen</translation>
        </message>
        <message>
            <source>Pages</source>
            <translation>Seiten</translation>
        </message>
        <message>
            <source>Axis Calibration</source>
            <translation>Achskalibrierung</translation>
        </message>
        <message>
            <source>Changes go into the open file; Ctrl+Z takes each back.</source>
            <translation>Änderungen gehen in die offene Datei; Strg+Z nimmt jede zurück.</translation>
        </message>
        <message>
            <source>The file is read-only.</source>
            <translation>Die Datei ist schreibgeschützt.</translation>
        </message>
        <message>
            <source>Do&amp;wnload 1 Value</source>
            <translation>1 Wert &amp;senden</translation>
        </message>
        <message>
            <source>Do&amp;wnload {count} Values</source>
            <translation>{count} Werte &amp;senden</translation>
        </message>
        <message>
            <source>It is not known what the control contains.</source>
            <translation>Es ist nicht bekannt, was die Steuerung enthält.</translation>
        </message>
        <message numerus="yes">
            <source>Each change goes into the control at once. Changed: %n. The file stays.</source>
            <translation>
                <numerusform>Jede Änderung geht sofort in die Steuerung. Geändert: %n. Die Datei bleibt.</numerusform>
                <numerusform>Jede Änderung geht sofort in die Steuerung. Geändert: %n. Die Datei bleibt.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>This control takes all values together, in E-stop. Changed: %n. The file stays.</source>
            <translation>
                <numerusform>Diese Steuerung nimmt alle Werte zusammen, im Not-Halt. Geändert: %n. Die Datei bleibt.</numerusform>
                <numerusform>Diese Steuerung nimmt alle Werte zusammen, im Not-Halt. Geändert: %n. Die Datei bleibt.</numerusform>
            </translation>
        </message>
        <message>
            <source>Read Control</source>
            <translation>Steuerung lesen</translation>
        </message>
        <message>
            <source>The control contains parameters for {found}, and the file is for {family}.</source>
            <translation>Die Steuerung enthält Parameter für {found}, und die Datei ist für {family}.</translation>
        </message>
        <message>
            <source>Measured Points</source>
            <translation>Messpunkte</translation>
        </message>
        <message>
            <source>Calibrate axis {axis}</source>
            <translation>Achse {axis} kalibrieren</translation>
        </message>
        <message>
            <source>Take from control</source>
            <translation>Aus der Steuerung nehmen</translation>
        </message>
        <message numerus="yes">
            <source>Values taken into the file, which is not saved yet: %n.</source>
            <translation>
                <numerusform>In die noch nicht gespeicherte Datei genommene Werte: %n.</numerusform>
                <numerusform>In die noch nicht gespeicherte Datei genommene Werte: %n.</numerusform>
            </translation>
        </message>
        <message>
            <source>It is not known what the control contains. Verify it before the machine is used.</source>
            <translation>Es ist nicht bekannt, was die Steuerung enthält. Vor dem Gebrauch der Maschine vergleichen.</translation>
        </message>
        <message>
            <source>&amp;Leave</source>
            <translation>&amp;Verlassen</translation>
        </message>
        <message>
            <source>Tuning</source>
            <translation>Abgleich</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Abbrechen</translation>
        </message>
        <message numerus="yes">
            <source>Values of the control that differ from when it was connected: %n. The file has them only if you took them.</source>
            <translation>
                <numerusform>Werte der Steuerung, die anders sind als beim Verbinden: %n. Die Datei hat sie nur, wenn sie genommen wurden.</numerusform>
                <numerusform>Werte der Steuerung, die anders sind als beim Verbinden: %n. Die Datei hat sie nur, wenn sie genommen wurden.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Values that were not downloaded and will be forgotten: %n.</source>
            <translation>
                <numerusform>Werte, die nicht gesendet wurden und vergessen werden: %n.</numerusform>
                <numerusform>Werte, die nicht gesendet wurden und vergessen werden: %n.</numerusform>
            </translation>
        </message>
        <message>
            <source>Put the Old Values &amp;Back</source>
            <translation>Alte Werte &amp;zurück</translation>
        </message>
        <message>
            <source>&amp;Keep Them in the Control</source>
            <translation>In der Steuerung &amp;behalten</translation>
        </message>
        <message>
            <source>&amp;Forget Them</source>
            <translation>&amp;Vergessen</translation>
        </message>
    </context>
    <context>
        <name>ValueDelegate</name>
        <message>
            <source>not set</source>
            <translation>nicht gesetzt</translation>
        </message>
        <message>
            <source>Allowed here: {range}</source>
            <translation>Hier erlaubt: {range}</translation>
        </message>
        <message>
            <source>keep {value}</source>
            <translation>{value} behalten</translation>
        </message>
        <message>
            <source>force and mark</source>
            <translation>erzwingen und kennzeichnen</translation>
        </message>
        <message numerus="yes">
            <source>fill %n cells</source>
            <translation>
                <numerusform>%n Zelle füllen</numerusform>
                <numerusform>%n Zellen füllen</numerusform>
            </translation>
        </message>
        <message>
            <source>Rules want {value}.</source>
            <translation>Regeln wollen {value}.</translation>
        </message>
    </context>
    <context>
        <name>ValueTable</name>
        <message>
            <source>Values</source>
            <translation>Werte</translation>
        </message>
    </context>
    <context>
        <name>ValuesPage</name>
        <message>
            <source>Values to tune: {page}</source>
            <translation>Werte zum Abgleichen: {page}</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>Achse</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>Value</source>
            <translation>Wert</translation>
        </message>
        <message>
            <source>Allowed</source>
            <translation>Erlaubt</translation>
        </message>
        <message>
            <source>Takes Effect</source>
            <translation>Wirkt</translation>
        </message>
        <message>
            <source>Step</source>
            <translation>Schritt</translation>
        </message>
        <message>
            <source>&amp;Decrease</source>
            <translation>&amp;Kleiner</translation>
        </message>
        <message>
            <source>&amp;Increase</source>
            <translation>&amp;Größer</translation>
        </message>
        <message>
            <source>&amp;Replace</source>
            <translation>E&amp;rsetzen</translation>
        </message>
        <message>
            <source>&amp;Add to Value…</source>
            <translation>Zum Wert &amp;addieren…</translation>
        </message>
        <message>
            <source>One step less (the key −; with Ctrl ten steps)</source>
            <translation>Ein Schritt weniger (Taste −; mit Strg zehn Schritte)</translation>
        </message>
        <message>
            <source>One step more (the key +; with Ctrl ten steps)</source>
            <translation>Ein Schritt mehr (Taste +; mit Strg zehn Schritte)</translation>
        </message>
        <message>
            <source>Type another value (F2)</source>
            <translation>Einen anderen Wert eingeben (F2)</translation>
        </message>
        <message>
            <source>Add a number to the value (A)</source>
            <translation>Eine Zahl zum Wert addieren (A)</translation>
        </message>
        <message>
            <source>&amp;Step</source>
            <translation>S&amp;chritt</translation>
        </message>
        <message>
            <source>Read &amp;Measured Points…</source>
            <translation>&amp;Messpunkte lesen…</translation>
        </message>
        <message>
            <source>Page {page}.</source>
            <translation>Seite {page}.</translation>
        </message>
        <message>
            <source>No axis of this file has any of these values.</source>
            <translation>Keine Achse dieser Datei hat einen dieser Werte.</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>Tune</source>
            <translation>Abgleichen</translation>
        </message>
        <message>
            <source>Add to {name}, now {value} ({unit}):</source>
            <translation>Zu {name} addieren, jetzt {value} ({unit}):</translation>
        </message>
        <message>
            <source>a number</source>
            <translation>eine Zahl</translation>
        </message>
        <message>
            <source>Add to Value</source>
            <translation>Zum Wert addieren</translation>
        </message>
        <message>
            <source>{text} is no bare number: it is added in {unit}.</source>
            <translation>{text} ist keine bloße Zahl: addiert wird in {unit}.</translation>
        </message>
        <message>
            <source>{name} is not used: {why}.</source>
            <translation>{name} wird nicht benutzt: {why}.</translation>
        </message>
    </context>
    <context>
        <name>ViewBar</name>
        <message>
            <source>Compare and merge</source>
            <translation>Vergleichen und zusammenführen</translation>
        </message>
        <message>
            <source>&amp;2 sources</source>
            <translation>&amp;2 Quellen</translation>
        </message>
        <message>
            <source>&amp;3 sources</source>
            <translation>&amp;3 Quellen</translation>
        </message>
        <message>
            <source>Swap A and B</source>
            <translation>A und B tauschen</translation>
        </message>
        <message>
            <source>Swap A and B (Alt+W)</source>
            <translation>A und B tauschen (Alt+W)</translation>
        </message>
        <message>
            <source>Only &amp;differences</source>
            <translation>Nur &amp;Unterschiede</translation>
        </message>
        <message>
            <source>Conflicts</source>
            <translation>Konflikte</translation>
        </message>
        <message>
            <source>Acti&amp;ve only</source>
            <translation>Nur ak&amp;tive</translation>
        </message>
        <message>
            <source>Filter by name, number</source>
            <translation>Nach Name, Nummer filtern</translation>
        </message>
        <message>
            <source>Filter</source>
            <translation>Filtern</translation>
        </message>
        <message>
            <source>Previous difference (Alt+Up)</source>
            <translation>Voriger Unterschied (Alt+Auf)</translation>
        </message>
        <message>
            <source>Next difference (Alt+Down)</source>
            <translation>Nächster Unterschied (Alt+Ab)</translation>
        </message>
    </context>
    <context>
        <name>WelcomeControls</name>
        <message>
            <source>Controls</source>
            <translation>Steuerungen</translation>
        </message>
        <message>
            <source>Connect</source>
            <translation>Verbinden</translation>
        </message>
        <message>
            <source>Upload…</source>
            <translation>Auslesen…</translation>
        </message>
        <message>
            <source>No control has been reached yet. Upload reads one into a new file.</source>
            <translation>Noch keine Steuerung wurde erreicht. Auslesen macht eine neue Datei daraus.</translation>
        </message>
        <message>
            <source>connected</source>
            <translation>verbunden</translation>
        </message>
        <message>
            <source>downloaded</source>
            <translation>gesendet</translation>
        </message>
        <message>
            <source>verified</source>
            <translation>verglichen</translation>
        </message>
        <message>
            <source>uploaded</source>
            <translation>ausgelesen</translation>
        </message>
        <message>
            <source>restored</source>
            <translation>zurückgespielt</translation>
        </message>
        <message>
            <source>family not known yet</source>
            <translation>Familie noch nicht bekannt</translation>
        </message>
        <message>
            <source>not reached</source>
            <translation>nicht erreicht</translation>
        </message>
        <message>
            <source>Control</source>
            <translation>Steuerung</translation>
        </message>
        <message>
            <source>in E-stop</source>
            <translation>im Not-Halt</translation>
        </message>
        <message>
            <source>not in E-stop</source>
            <translation>nicht im Not-Halt</translation>
        </message>
        <message>
            <source>revision {revision}</source>
            <translation>Stand {revision}</translation>
        </message>
        <message>
            <source>{address} answers: {family}</source>
            <translation>{address} antwortet: {family}</translation>
        </message>
        <message>
            <source>Upload</source>
            <translation>Auslesen</translation>
        </message>
        <message>
            <source>&amp;Connect</source>
            <translation>&amp;Verbinden</translation>
        </message>
        <message>
            <source>&amp;Upload…</source>
            <translation>&amp;Auslesen…</translation>
        </message>
        <message>
            <source>&amp;Remove from the List</source>
            <translation>Aus der Liste &amp;entfernen</translation>
        </message>
    </context>
    <context>
        <name>WelcomePage</name>
        <message>
            <source>Welcome</source>
            <translation>Willkommen</translation>
        </message>
        <message>
            <source>New file</source>
            <translation>Neue Datei</translation>
        </message>
        <message>
            <source>Examples</source>
            <translation>Beispiele</translation>
        </message>
        <message>
            <source>Recent files</source>
            <translation>Letzte Dateien</translation>
        </message>
        <message>
            <source>parameters</source>
            <translation>Parameter</translation>
        </message>
        <message>
            <source>Filter</source>
            <translation>Filtern</translation>
        </message>
        <message>
            <source>Filter the recent files</source>
            <translation>Die letzten Dateien filtern</translation>
        </message>
        <message>
            <source>Drop files or a project folder anywhere in this window. Ctrl+Shift+P finds every command by its name.</source>
            <translation>Dateien oder einen Projektordner irgendwo in dieses Fenster ziehen. Strg+Umschalt+P findet jeden Befehl nach Namen.</translation>
        </message>
        <message>
            <source>Open…</source>
            <translation>Öffnen…</translation>
        </message>
        <message>
            <source>Open Project…</source>
            <translation>Projekt öffnen…</translation>
        </message>
        <message>
            <source>cannot be read</source>
            <translation>nicht lesbar</translation>
        </message>
        <message>
            <source>no findings</source>
            <translation>keine Befunde</translation>
        </message>
        <message>
            <source>No recent file has '{text}' in its name, folder or machine.</source>
            <translation>Keine der letzten Dateien hat „{text}“ in Name, Ordner oder Maschine.</translation>
        </message>
        <message>
            <source>No file has been opened yet. Begin with an example, or with a new file.</source>
            <translation>Noch keine Datei wurde geöffnet. Mit einem Beispiel oder einer neuen Datei beginnen.</translation>
        </message>
        <message>
            <source>These files were open the last time: {names}.</source>
            <translation>Diese Dateien waren zuletzt offen: {names}.</translation>
        </message>
        <message>
            <source>Open All</source>
            <translation>Alle öffnen</translation>
        </message>
        <message>
            <source>a copy is opened</source>
            <translation>eine Kopie wird geöffnet</translation>
        </message>
        <message>
            <source>Open</source>
            <translation>Öffnen</translation>
        </message>
        <message>
            <source>New</source>
            <translation>Neu</translation>
        </message>
        <message>
            <source>Example</source>
            <translation>Beispiel</translation>
        </message>
        <message>
            <source>&amp;Open</source>
            <translation>Ö&amp;ffnen</translation>
        </message>
        <message>
            <source>Un&amp;pin</source>
            <translation>&amp;Lösen</translation>
        </message>
        <message>
            <source>&amp;Pin to the Top</source>
            <translation>Oben an&amp;heften</translation>
        </message>
        <message>
            <source>&amp;Remove from the List</source>
            <translation>Aus der Liste &amp;entfernen</translation>
        </message>
        <message>
            <source>&amp;Show in Its Folder</source>
            <translation>Im &amp;Ordner zeigen</translation>
        </message>
        <message>
            <source>&amp;New File…</source>
            <translation>&amp;Neue Datei…</translation>
        </message>
        <message>
            <source>Copy of {title}…</source>
            <translation>Kopie von {title}…</translation>
        </message>
    </context>
    <context>
        <name>WhyDialog</name>
        <message>
            <source>Why</source>
            <translation>Warum</translation>
        </message>
        <message>
            <source>Applies where</source>
            <translation>Gilt, wo</translation>
        </message>
        <message>
            <source>Demands</source>
            <translation>Verlangt</translation>
        </message>
        <message>
            <source>With the values</source>
            <translation>Mit den Werten</translation>
        </message>
        <message>
            <source>Comes to</source>
            <translation>Ergibt</translation>
        </message>
    </context>
    <context>
        <name>WordPanel</name>
        <message>
            <source>bit {bit}</source>
            <translation>Bit {bit}</translation>
        </message>
        <message>
            <source>another code</source>
            <translation>ein anderer Code</translation>
        </message>
        <message>
            <source>bits {bit} to {what}</source>
            <translation>Bits {bit} bis {what}</translation>
        </message>
    </context>
    <context>
        <name>Workspace</name>
        <message>
            <source>on {now} in the studio</source>
            <translation>am {now} im Studio</translation>
        </message>
        <message numerus="yes">
            <source>Set %n values of {name}</source>
            <translation>
                <numerusform>%n Wert von {name} setzen</numerusform>
                <numerusform>%n Werte von {name} setzen</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Set %n values</source>
            <translation>
                <numerusform>%n Wert setzen</numerusform>
                <numerusform>%n Werte setzen</numerusform>
            </translation>
        </message>
        <message>
            <source>Clear {name}</source>
            <translation>{name} leeren</translation>
        </message>
        <message>
            <source>Set {name} to {value}</source>
            <translation>{name} auf {value} setzen</translation>
        </message>
    </context>
    <context>
        <name>self.box</name>
        <message numerus="yes">
            <source>Show %n parameters in the table</source>
            <translation>
                <numerusform>%n Parameter in der Tabelle zeigen</numerusform>
                <numerusform>%n Parameter in der Tabelle zeigen</numerusform>
            </translation>
        </message>
        <message>
            <source>Nothing found</source>
            <translation>Nichts gefunden</translation>
        </message>
        <message>
            <source>Did you mean “{words}”?</source>
            <translation>Gemeint „{words}“?</translation>
        </message>
        <message>
            <source>In {family}: {title}</source>
            <translation>In {family}: {title}</translation>
        </message>
        <message>
            <source>Show all parameters in the table</source>
            <translation>Alle Parameter in der Tabelle zeigen</translation>
        </message>
        <message>
            <source>Report a word that is missing</source>
            <translation>Ein fehlendes Wort melden</translation>
        </message>
    </context>
</TS>
