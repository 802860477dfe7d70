/* The search of the site: numbers, names, ids, messages, pages of manuals, each with its anchor, while one types and at the
   head of the page of results. It reads _static/search-entries.js (scripts/reference_search.py), a script because a
   browser lets a page of file:// read nothing else, and only once somebody searches. */
"use strict";
(() => {
  const MOST = 12;
  // What words are worth in a title, in choices and other spellings, in help; and what kinds are among equals.
  const WORTH = [8, 6, 1.5];
  const KINDS = { parameter: 1, message: 1, guide: 0.9, internals: 0.6, table: 0.7, group: 0.75, list: 0.75, step: 0.7, rule: 0.5, page: 0.6, contradiction: 0.5 };
  const COMMON = new Set("a an and are as at be by do does for from how i in into is it my of on or per that the this to what when where which why with auf bei beim das dem den der die ein eine einen im ist nach sich vom von wird werden wie warum wenn wo zum zur".split(" "));
  const root = document.documentElement.dataset.content_root || "./";
  let entries = null; // once they are loaded
  let exact = null; // a name without spaces -> [entry, score, address]
  let vocabulary = null; // words of titles, for those that are mistyped
  let waiting = [];
  const synonyms = new Map(); // words of the trade -> questions in the words of the manuals, the likeliest first

  // -- what is known ---------------------------------------------------------

  const wordsOf = (text) => text.toLowerCase().match(/\d+(?:\.\d+)+|[\p{L}\p{N}]+/gu) || [];
  // MOT-022, mot 22 and MOT22 are one code; 7-17 is not 717.
  const bare = (text) => text.toLowerCase().replace(/[\s#@]+/g, "").replace(/([a-z])[-:_]?0*(?=\d)/g, "$1");
  const spaced = (text) => ` ${wordsOf(text).join(" ")} `;

  window.searchEntries = (families) => {
    entries = [];
    exact = new Map();
    families.forEach(({ family, names, folder, entries: own }) => {
      const called = names.map((name) => wordsOf(name).join(" "));
      own.forEach(([kind, title, address, known, more, text]) => {
        const entry = { family, called, kind, title, more, address: folder + address, order: entries.length,
          id: kind === "parameter" ? known[0] : "",
          texts: [spaced(`${title} ${kind === "parameter" ? known[0].replace(/[._]/g, " ") : ""}`), spaced(more), ` ${text} `] };
        entries.push(entry);
        known.forEach((name, n) => {
          if (kind === "message" && !/\d/.test(name)) return; // words that a control shows are a title, not a number
          const number = kind === "parameter" && n > 0;
          const page = kind === "page";
          const place = `${folder}${address.split("#")[0]}#n-${encodeURIComponent(name)}`;
          // What several parameters of a group share is the anchor of the first.
          const shared = (exact.get(bare(name)) || []).some(([, , other]) => other === place);
          const at = number && !shared ? place : entry.address;
          know(page ? `page${name.toLowerCase()}` : bare(name), entry, page ? 99 : 100, at);
          if (page && /[-.]|^[A-Z]/.test(name)) know(name.toLowerCase(), entry, 90, at);
          const word = number && name.match(/^(.*\d)[a-z]\d+$/i); // P21 of P21N0
          if (word) know(bare(word[1]), entry, 100.5, entry.address);
          const figures = number && name.match(/^\D+0*(\d+)$/); // 61 of Pr61
          if (figures) know(figures[1], entry, 60, at);
        });
      });
    });
    const due = waiting;
    waiting = [];
    due.forEach((call) => call());
  };

  // Words of the trade and German ones, of parameter_db/synonyms.yaml.
  window.searchSynonyms = (table) => table.forEach(([words, mean]) => words.forEach((word) => synonyms.set(folded(word).join(" "), mean)));

  const know = (name, entry, score, address) => {
    const found = exact.get(name);
    if (!found) exact.set(name, [[entry, score, address]]);
    else if (!found.some(([other]) => other === entry)) found.push([entry, score, address]);
  };

  const load = (call) => {
    if (entries) return call();
    waiting.push(call);
    if (waiting.length > 1) return undefined;
    const script = document.createElement("script");
    script.src = `${root}_static/search-entries.js`;
    document.head.append(script);
    return undefined;
  };

  // -- search ----------------------------------------------------------------

  const distance = (a, b, most) => {
    if (Math.abs(a.length - b.length) > most) return most + 1;
    let before = [], row = Array.from({ length: b.length + 1 }, (_, n) => n), last;
    for (let i = 1; i <= a.length; i += 1) {
      [last, before, row] = [before, row, [i]];
      for (let j = 1; j <= b.length; j += 1) {
        row[j] = Math.min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] !== b[j - 1]));
        if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j], last[j - 2] + 1);
      }
    }
    return row[b.length];
  };

  const folded = (text) => wordsOf(text).map((word) => word.replace(/[äöüß]/g, (letter) => ({ ä: "ae", ö: "oe", ü: "ue", ß: "ss" })[letter]));

  const has = (start) => entries.some(({ texts }) => texts.some((text) => text.includes(start)));

  // What a question may mean in the words of the manuals: its longest group of words that is a synonym, as it is, only begun, with a German
  // ending or with one slip. The program does the same (amp_studio/find/synonyms.py).
  const meanings = (query) => {
    const words = folded(query);
    const alike = (typed, word) => typed === word || (typed.length >= 6 && word.length >= 6
      && ((typed.startsWith(word) && /^(e|n|en|er|s|es)$/.test(typed.slice(word.length))) || distance(typed, word, 1) <= 1));
    const like = (typed, last) => {
      if (synonyms.has(typed.join(" "))) return typed.join(" ");
      if (!typed.some((word) => word.length >= 5)) return undefined;
      const same = [...synonyms.keys()].filter((key) => key.split(" ").length === typed.length);
      const begun = last && typed[typed.length - 1].length >= 5 ? same.filter((key) => key.startsWith(typed.join(" "))) : [];
      return begun.sort((a, b) => a.length - b.length)[0] || same.find((key) => key.split(" ").every((word, n) => alike(typed[n], word)));
    };
    for (let length = words.length; length > 0; length -= 1)
      for (let start = 0; start + length <= words.length; start += 1) {
        const known = like(words.slice(start, start + length), start + length === words.length);
        const rest = [...words.slice(0, start), ...words.slice(start + length)];
        if (known) return synonyms.get(known).flatMap((mean, place) => [
          [[...words.slice(0, start), mean, ...words.slice(start + length)].join(" "), place],
          ...(rest.every((word) => has(` ${word}`)) ? [] : [[mean, place + 2]]), // "Endschalter ausgelöst": no manual has the rest
        ]);
      }
    return [];
  };

  // The known words that a typed one may be: itself or its beginning, or with one or two slips. A number that is known is whole.
  const meant = (word) => {
    if (/^\d+$/.test(word) && (exact.has(word) || has(` ${word} `))) return [[`${word} `, 1]];
    if (has(` ${word}`) || word.length < 4 || /\d/.test(word)) return [[word, 1]];
    vocabulary = vocabulary || new Set(entries.flatMap(({ texts }) => texts.slice(0, 2).flatMap((text) => text.split(" "))));
    const most = word.length > 6 ? 2 : 1;
    return [...vocabulary].map((known) => [known, distance(word, known, most)])
      .filter(([known, slips]) => known.length > 2 && slips <= most).map(([known, slips]) => [known, slips === 1 ? 0.7 : 0.5]);
  };

  // What one typed word is worth in an entry.
  const worth = (texts, likes) => {
    let best = 0;
    likes.forEach(([word, like]) => texts.forEach((text, n) => {
      const at = text.indexOf(` ${word}`);
      if (at >= 0) best = Math.max(best, WORTH[n] * like * (text.includes(` ${word.trim()} `) ? 1 : n === 2 ? 0.6 : 0.85));
    }));
    return best;
  };

  // Takes the name of a family off a question, where more is asked: "loop gain num", "9/PC 1300".
  const ofFamily = (query) => {
    const asked = wordsOf(query).join(" ");
    const names = [...new Set(entries.flatMap(({ called }) => called))].filter(Boolean).sort((a, b) => b.length - a.length);
    const name = names.find((one) => asked.startsWith(`${one} `) || asked.endsWith(` ${one}`));
    if (!name) return [query, ""];
    const pattern = name.split(" ").map((word) => word.replace(/\./g, "\\.")).join("\\W*");
    const ends = asked.endsWith(` ${name}`) ? `(.*)\\b${pattern}\\W*$` : `^\\W*${pattern}\\b(.*)`;
    const rest = query.match(new RegExp(ends, "i"));
    return rest && rest[1].trim() ? [rest[1].trim(), name] : [query, ""];
  };

  const search = (typed) => {
    // Which axis, bit or value is meant decides no place: 1300@X, $3=1, R66 bit 3, axis 2 home calibration.
    const asked = typed.trim().replace(/\s+/g, " ").slice(0, 200);
    const plain = asked.replace(/(@\w+|\s?=\s?[-.\d]+| bit \d+| axis (\d+|[a-z]))$|^axis (\d+|[a-z]) (?=\S)/i, "");
    if (!entries || !plain) return [];
    const whole = exactly(asked).length ? asked : plain;
    const own = exactly(whole);
    const [query, family] = own.length ? [whole, ""] : ofFamily(whole);
    const found = new Map();
    const add = (entry, score, address) => {
      if ((!family || entry.called.includes(family)) && score > (found.get(entry) || { score: 0 }).score)
        found.set(entry, { entry, score, address });
    };
    (own.length ? own : exactly(query)).forEach((hit) => add(...hit));
    byWords(query, add);
    // Another word is worth less than the one typed, and each less likely meaning less again.
    meanings(query).forEach(([mean, place]) => byWords(mean, (entry, score, address) => add(entry, score * 0.9 * 0.8 ** place, address), true));
    const hits = [...found.values()].sort((a, b) => b.score - a.score || a.entry.order - b.entry.order);
    // What nearly nothing speaks for only buries the rest.
    const best = Math.max(...hits.map(({ score }) => score).filter((score) => score < 60), 0);
    return hits.filter(({ score }) => score >= 0.25 * best).slice(0, MOST);
  };

  const exactly = (typed) => {
    const query = typed.replace(/^(?:parameter|param|number|no\.?|nr\.?)\s+(?=\S*\d)/i, "")
      .replace(/^register\s+(?=\d)/i, "R").replace(/^setting\s+(?=\d)/i, "$$");
    const hits = [...(exact.get(bare(query)) || [])];
    if (/^[\d.-]+[a-z]?$/i.test(query)) hits.push(...(exact.get(query.toLowerCase()) || []));
    const page = query.match(/^(?:pages?|pg|p|seite|s|section|chapter)\b\.?\s*([\da-z][\w.-]*)$/i);
    if (page) hits.push(...(exact.get(`page${page[1].toLowerCase()}`) || []));
    if (page || /^\d+-\d+$/.test(query)) hits.push(...pageBefore(page ? page[1] : query, new Set(hits.map(([{ family }]) => family))));
    const last = query.match(/^[\w]+\.([\w]+)$/); // an id of which the group is another
    if (last && !hits.length)
      entries.forEach((entry) => entry.id.split(".").pop() === last[1].toLowerCase() && hits.push([entry, 50, entry.address]));
    return hits;
  };

  // Nothing is listed for a page that only goes on with what the one before began: that one, of the families without a hit.
  const pageBefore = (page, having) => {
    const [, chapter, number] = page.toUpperCase().match(/^(.*?)(\d+)$/) || [];
    const best = new Map();
    entries.forEach((entry) => {
      const [, own, at] = entry.kind === "page" ? entry.title.match(/^Page (.*?)(\d+)$/) || [] : [];
      if (own === undefined || having.has(entry.family) || own !== chapter || !own || Number(at) >= Number(number)) return;
      const other = best.get(entry.family);
      if (!other || Number(at) > other[0]) best.set(entry.family, [Number(at), entry]);
    });
    return [...best.values()].map(([, entry]) => [entry, 70, entry.address]);
  };

  const byWords = (query, add, every = false) => {
    const asked = wordsOf(query).join(" ");
    const typed = wordsOf(query.replace(/_/g, " ").replace(/\.(?=\D)/g, " "));
    let words = [...new Set(typed)];
    if (words.some((word) => !COMMON.has(word))) words = words.filter((word) => !COMMON.has(word));
    words = words.slice(0, 12); // a text that was pasted by mistake
    const titled = (word) => entries.some(({ texts }) => texts[0].includes(` ${word} `));
    const counted = words.map((word) => {
      // Two words may be known as one: in position, inposition.
      const at = typed.indexOf(word);
      const joined = [at > 0 && typed[at - 1] + word, at + 1 < typed.length && word + typed[at + 1]]
        .filter((one) => one && !/^\d+$/.test(one) && titled(one));
      const likes = [...meant(word), ...joined.map((one) => [one, 1])];
      const values = entries.map(({ texts }) => worth(texts, likes));
      (exact.get(word) || []).forEach(([entry]) => { values[entry.order] = 10; });
      const many = values.filter(Boolean).length;
      return { values, weight: 1 + Math.log((entries.length + 1) / (many + 1)) / Math.log(entries.length + 2), digits: /\d/.test(word) };
    });
    const total = counted.reduce((sum, { weight }) => sum + weight, 0);
    const all = entries.some((_, n) => counted.every(({ values }) => values[n]));
    entries.forEach((entry, n) => {
      const missing = counted.filter(({ values }) => !values[n]);
      if (missing.length > (every ? 0 : Math.floor(words.length / (all ? 4 : 2))) || missing.length === words.length || missing.some(({ digits }) => digits)) return;
      let score = counted.reduce((sum, { values, weight }) => sum + weight * values[n], 0) / total;
      const title = wordsOf(entry.title).join(" ");
      const name = title.replace(/^\S*\d\S* /, ""); // without its number
      if (title === asked || name === asked) score += 6;
      else if (title.startsWith(asked) || `${name} `.startsWith(`${asked} `)) score += 3;
      else if (entry.texts[0].includes(asked)) score += 2;
      add(entry, score * KINDS[entry.kind] * 0.4 ** missing.length, entry.address);
    });
  };

  // -- what is seen ----------------------------------------------------------

  const element = (tag, properties, ...children) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  };

  // The choice or other spelling that has the words, where the title has not.
  const chosen = (entry, query) => {
    const words = wordsOf(query);
    if (words.every((word) => entry.texts[0].includes(` ${word}`))) return "";
    return entry.more.split("; ").find((label) => words.every((word) => spaced(label).includes(` ${word}`))) || "";
  };

  const shown = ({ entry, address }, query) => {
    const number = decodeURIComponent((address.split("#n-")[1] || ""));
    const title = number && !entry.title.startsWith(`${number} `) ? `${number} ${entry.title.replace(/^\S*\d\S* /, "")}` : entry.title;
    const choice = chosen(entry, query);
    const guide = /^(guide|internals)$/.test(entry.kind) && entry.address.replace(/\.html.*/, "");
    const detail = [guide ? "guide" : entry.kind, entry.id || guide, choice].filter(Boolean).join(" · ");
    const lines = [element("span", { className: "found-title", textContent: title }), element("span", { className: "found-detail", textContent: detail })];
    if (entry.family) lines.unshift(element("span", { className: "found-family", textContent: entry.family }));
    return element("a", { href: root + address, className: "found" }, ...lines);
  };

  // Suggestions below a field: arrows choose, Enter opens, Esc closes; without a choice Enter leads to all results.
  const suggest = (field, number) => {
    const list = element("div", { className: "suggestions", id: `suggestions-${number}`, hidden: true });
    list.setAttribute("role", "listbox");
    list.setAttribute("aria-label", "Suggestions");
    Object.entries({ role: "combobox", "aria-expanded": "false", "aria-controls": list.id, "aria-autocomplete": "list" })
      .forEach(([name, value]) => field.setAttribute(name, value));
    field.autocomplete = "off";
    field.form.append(list);
    let at = -1;
    const choose = (n) => {
      const links = [...list.children];
      at = links.length ? (n + 1 + links.length + 1) % (links.length + 1) - 1 : -1;
      links.forEach((link, m) => link.setAttribute("aria-selected", String(m === at)));
      if (at >= 0) links[at].scrollIntoView({ block: "nearest" });
      field.setAttribute("aria-activedescendant", at >= 0 ? links[at].id : "");
    };
    const open = (is) => {
      list.hidden = !is || !list.children.length;
      field.setAttribute("aria-expanded", String(!list.hidden));
    };
    const ask = () => load(() => {
      list.replaceChildren(...search(field.value).map((hit, n) => {
        const link = shown(hit, field.value);
        link.id = `${list.id}-${n}`;
        link.setAttribute("role", "option");
        link.tabIndex = -1;
        return link;
      }));
      choose(-1);
      open(document.activeElement === field);
    });
    field.addEventListener("input", ask);
    field.addEventListener("focus", ask);
    field.addEventListener("blur", () => setTimeout(() => open(list.contains(document.activeElement)), 150));
    list.addEventListener("mousedown", (event) => event.preventDefault()); // the field stays the one typed into
    list.addEventListener("click", () => { open(false); field.blur(); });
    field.addEventListener("keydown", (event) => {
      if (event.key === "ArrowDown" || event.key === "ArrowUp") {
        choose(at + (event.key === "ArrowDown" ? 1 : -1));
        event.preventDefault();
      } else if (event.key === "Enter" && at >= 0 && !list.hidden) {
        list.children[at].click();
        event.preventDefault();
      } else if (event.key === "Escape") open(false);
    });
  };

  // The page of results: our hits first, and what Sphinx finds in the texts below them.
  const results = (place) => {
    const query = new URLSearchParams(location.search).get("q");
    if (!query) return;
    document.querySelectorAll("input[name=q]").forEach((field) => { field.value = query; });
    load(() => {
      const hits = search(query);
      if (!hits.length) return;
      const list = element("ul", { className: "search" }, ...hits.map((hit) => element("li", {}, shown(hit, query))));
      place.classList.add("has-best");
      place.prepend(element("h2", { className: "best", textContent: "Best matches" }), list);
    });
  };

  const start = () => {
    const place = document.getElementById("search-results");
    if (place) { // on a phone the other field is folded away
      const field = element("input", { name: "q", type: "search", ariaLabel: "Search" });
      const form = element("form", { className: "front-search", role: "search", action: "search.html" }, field);
      place.before(form);
    }
    document.querySelectorAll("form[role=search] input[name=q]").forEach(suggest);
    if (place) results(place);
  };
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();
  window.searchSite = (query) => search(query).map(({ address }) => address);
})();
