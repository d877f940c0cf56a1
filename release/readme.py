"""The README for the package index, which knows no files beside it: a hook of hatchling.

Links to files become links to the repository that `[project.urls]` names as `Source`. Without one they become plain
text, and pictures are left out.
"""

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

#: A link or a picture in Markdown whose target is a file.
RELATIVE = re.compile(r"(!?)\[([^\]]*)\]\((?![a-z]+:|#)([^)\s]+)\)")


def for_index(text: str, source: str | None) -> str:
    """Rewrite the links to files.

    Parameters
    ----------
    text : str
        Markdown.
    source : str or None
        Address of the repository.

    Returns
    -------
    str
    """

    def rewritten(match: re.Match[str]) -> str:
        picture, words, target = match.groups()
        if source is None:
            return "" if picture else words
        return f"{picture}[{words}]({source.rstrip('/')}/{'raw' if picture else 'blob'}/main/{target})"

    return re.sub(r"\n{3,}", "\n\n", RELATIVE.sub(rewritten, text))


class ReadmeHook(MetadataHookInterface):
    """Gives hatchling the rewritten README."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the description of the package."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        source = metadata.get("urls", {}).get("Source")
        metadata["readme"] = {"content-type": "text/markdown", "text": for_index(text, source)}
