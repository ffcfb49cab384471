"""slugs.py - the names of headings that links go to, as where the Markdown is read elsewhere."""

import re


def as_on_github(text: str, separator: str) -> str:
    """Small letters, digits, hyphens and underscores; each blank a separator."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", separator)
