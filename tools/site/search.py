"""Hook of MkDocs: names of the C++ reference in the search of the site, and sections before pages."""

import json
import os
import re
import xml.etree.ElementTree as ElementTree
from typing import Any

KINDS = ("dir", "file", "function", "class", "struct", "union", "concept", "enum", "variable", "typedef")


def on_post_build(config: Any) -> None:
    """Adds what Doxygen has found, and lets a search lead to sections first.

    The theme shows a section's hit where its page has one too. A page with all its text would be
    before its sections, which lead to the place itself: it is found by each of its words once.
    """
    path = os.path.join(config["site_dir"], "search/search_index.json")
    with open(path, encoding="utf-8") as file:
        index = json.load(file)
    for entry in index["docs"]:
        if "#" not in entry["location"]:
            entry["text"] = " ".join(dict.fromkeys(re.findall(r"[\w']+", entry["text"].lower())))
        elif entry["location"].startswith("reference/python/") and "#sinew." in entry["location"]:
            entry["title"] = re.sub(r"\.init$", "(…)", entry["location"].partition("#")[2])
    found = [{f.get("name"): f.text or "" for f in doc}
             for doc in ElementTree.parse(os.path.join(config["docs_dir"], "../searchdata.xml")).getroot()]
    # The theme needs a page before its sections, of which the first is that of the title.
    for field in sorted(found, key=lambda f: "#" in f["url"]):
        if field["type"] in KINDS and "@" not in field["name"]:
            title = re.sub(r"^sinew::(\w+::(?=\w+::))?", "", field["name"])
            title = field["name"].replace("::", "/") if field["type"] == "dir" else title
            for place in [field["url"]] if "#" in field["url"] else [field["url"], field["url"] + "#top"]:
                index["docs"].append({"location": f"reference/cpp/{place}", "title": title, "text": field.get("text", "")})
    with open(path, "w", encoding="utf-8") as file:
        json.dump(index, file, ensure_ascii=False, separators=(",", ":"))
