<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en">
    <context>
        <name />
        <message numerus="yes">
            <source>%n cells are beyond the table.</source>
            <translation>
                <numerusform>%n cell is beyond the table.</numerusform>
                <numerusform>%n cells are beyond the table.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>and %n more</source>
            <translation>
                <numerusform>and %n more</numerusform>
                <numerusform>and %n more</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n values have no printed default and are as before.</source>
            <translation>
                <numerusform>%n value has no printed default and is as before.</numerusform>
                <numerusform>%n values have no printed default and are as before.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Conflicts left: %n</source>
            <translation>
                <numerusform>%n conflict left</numerusform>
                <numerusform>%n conflicts left</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Write %n values</source>
            <translation>
                <numerusform>Write %n value</numerusform>
                <numerusform>Write %n values</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>BlockPreview</name>
        <message numerus="yes">
            <source>%n cells</source>
            <translation>
                <numerusform>%n cell</numerusform>
                <numerusform>%n cells</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n change</source>
            <translation>
                <numerusform>%n changes</numerusform>
                <numerusform>%n change</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n the same</source>
            <translation>
                <numerusform>%n the same</numerusform>
                <numerusform>%n the same</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n refused</source>
            <translation>
                <numerusform>%n refused</numerusform>
                <numerusform>%n refused</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>&amp;Paste %n</source>
            <translation>
                <numerusform>&amp;Paste %n</numerusform>
                <numerusform>&amp;Paste %n</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>Comparisons</name>
        <message numerus="yes">
            <source>Merged with {source}. Values changed: %n.</source>
            <translation>
                <numerusform>Merged with {source}. %n value changed.</numerusform>
                <numerusform>Merged with {source}. %n values changed.</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>ControlPage</name>
        <message numerus="yes">
            <source>%n errors</source>
            <translation>
                <numerusform>%n error</numerusform>
                <numerusform>%n errors</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>I have checked what can be dangerous: %n</source>
            <translation>
                <numerusform>I have checked what can be dangerous: %n</numerusform>
                <numerusform>I have checked what can be dangerous: %n</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Send %n Values to the Control…</source>
            <translation>
                <numerusform>Send %n Value to the Control…</numerusform>
                <numerusform>Send %n Values to the Control…</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Send %n Values to the Control</source>
            <translation>
                <numerusform>Send %n Value to the Control</numerusform>
                <numerusform>Send %n Values to the Control</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Take %n Values into {name}</source>
            <translation>
                <numerusform>Take %n Value into {name}</numerusform>
                <numerusform>Take %n Values into {name}</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>FilePage</name>
        <message numerus="yes">
            <source>%n cells</source>
            <translation>
                <numerusform>%n cell</numerusform>
                <numerusform>%n cells</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n cells of {name}</source>
            <translation>
                <numerusform>%n cell of {name}</numerusform>
                <numerusform>%n cells of {name}</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>FindBox</name>
        <message numerus="yes">
            <source>%n found</source>
            <translation>
                <numerusform>%n found</numerusform>
                <numerusform>%n found</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>FindingsPanel</name>
        <message numerus="yes">
            <source>{number} as delivered, to be set in steps {steps}</source>
            <translation>
                <numerusform>{number} as delivered, to be set in step {steps}</numerusform>
                <numerusform>{number} as delivered, to be set in steps {steps}</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>GroupList</name>
        <message numerus="yes">
            <source>%n values not set</source>
            <translation>
                <numerusform>%n value not set</numerusform>
                <numerusform>%n values not set</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>MeasuredDialog</name>
        <message numerus="yes">
            <source>Circles of a ball-bar: %n</source>
            <translation>
                <numerusform>%n circle of a ball-bar</numerusform>
                <numerusform>%n circles of a ball-bar</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>MergeModel</name>
        <message numerus="yes">
            <source>%n differ</source>
            <translation>
                <numerusform>%n differs</numerusform>
                <numerusform>%n differ</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>conflicts: %n</source>
            <translation>
                <numerusform>%n conflict</numerusform>
                <numerusform>%n conflicts</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>MergeSources</name>
        <message numerus="yes">
            <source>this file, unsaved changes: %n</source>
            <translation>
                <numerusform>this file, %n unsaved change</numerusform>
                <numerusform>this file, %n unsaved changes</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>MergeWindow</name>
        <message numerus="yes">
            <source>&amp;Merge Anyway (New Errors: %n)</source>
            <translation>
                <numerusform>&amp;Merge Anyway (%n New Error)</numerusform>
                <numerusform>&amp;Merge Anyway (%n New Errors)</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>MotionView</name>
        <message numerus="yes">
            <source>Figures of the machine that are assumed: &lt;b&gt;%n&lt;/b&gt;, see Assumed.</source>
            <translation>
                <numerusform>&lt;b&gt;%n figure of the machine is assumed&lt;/b&gt;, see Assumed.</numerusform>
                <numerusform>&lt;b&gt;%n figures of the machine are assumed&lt;/b&gt;, see Assumed.</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>PictureCard</name>
        <message numerus="yes">
            <source>%n more</source>
            <translation>
                <numerusform>%n more</numerusform>
                <numerusform>%n more</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>ResultBar</name>
        <message numerus="yes">
            <source>Changes so far: %n</source>
            <translation>
                <numerusform>%n change so far</numerusform>
                <numerusform>%n changes so far</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>New errors: %n</source>
            <translation>
                <numerusform>%n new error</numerusform>
                <numerusform>%n new errors</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>New warnings: %n</source>
            <translation>
                <numerusform>%n new warning</numerusform>
                <numerusform>%n new warnings</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>SeveralControls</name>
        <message numerus="yes">
            <source>Send to %n Controls</source>
            <translation>
                <numerusform>Send to %n Control</numerusform>
                <numerusform>Send to %n Controls</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Compare With %n Controls</source>
            <translation>
                <numerusform>Compare With %n Control</numerusform>
                <numerusform>Compare With %n Controls</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>StatusLine</name>
        <message numerus="yes">
            <source>%n unsaved changes</source>
            <translation>
                <numerusform>%n unsaved change</numerusform>
                <numerusform>%n unsaved changes</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n axes</source>
            <translation>
                <numerusform>%n axis</numerusform>
                <numerusform>%n axes</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>StepsPanel</name>
        <message numerus="yes">
            <source>%n later findings held back</source>
            <translation>
                <numerusform>%n later finding held back</numerusform>
                <numerusform>%n later findings held back</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n values not set</source>
            <translation>
                <numerusform>%n value not set</numerusform>
                <numerusform>%n values not set</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n at the default</source>
            <translation>
                <numerusform>%n at the default</numerusform>
                <numerusform>%n at the default</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>TuningWindow</name>
        <message numerus="yes">
            <source>Each change goes into the control at once. Changed: %n. The file stays.</source>
            <translation>
                <numerusform>Each change goes into the control at once. %n value changed. The file stays.</numerusform>
                <numerusform>Each change goes into the control at once. %n values changed. The file stays.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>This control takes all values together, in E-stop. Changed: %n. The file stays.</source>
            <translation>
                <numerusform>This control takes all values together, in E-stop. %n value changed. The file stays.</numerusform>
                <numerusform>This control takes all values together, in E-stop. %n values changed. The file stays.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Values taken into the file, which is not saved yet: %n.</source>
            <translation>
                <numerusform>%n value taken into the file, which is not saved yet.</numerusform>
                <numerusform>%n values taken into the file, which is not saved yet.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Values of the control that differ from when it was connected: %n. The file has them only if you took them.</source>
            <translation>
                <numerusform>%n value of the control differs from when it was connected. The file has it only if you took it.</numerusform>
                <numerusform>%n values of the control differ from when it was connected. The file has them only if you took them.</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Values that were not downloaded and will be forgotten: %n.</source>
            <translation>
                <numerusform>%n value was not downloaded and will be forgotten.</numerusform>
                <numerusform>%n values were not downloaded and will be forgotten.</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>ValueDelegate</name>
        <message numerus="yes">
            <source>fill %n cells</source>
            <translation>
                <numerusform>fill %n cell</numerusform>
                <numerusform>fill %n cells</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>Workspace</name>
        <message numerus="yes">
            <source>Set %n values of {name}</source>
            <translation>
                <numerusform>Set %n value of {name}</numerusform>
                <numerusform>Set %n values of {name}</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>Set %n values</source>
            <translation>
                <numerusform>Set %n value</numerusform>
                <numerusform>Set %n values</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>self.box</name>
        <message numerus="yes">
            <source>Show %n parameters in the table</source>
            <translation>
                <numerusform>Show %n parameter in the table</numerusform>
                <numerusform>Show %n parameters in the table</numerusform>
            </translation>
        </message>
    </context>
</TS>
