"""Text of a file from a testing machine: its encoding, and errors for files that hold no text."""

import codecs
import csv
from pathlib import Path

from turgor.foundation.errors import TurgorError

#: Byte order marks, which state the encoding of a file; the longer of two marks that begin alike comes first.
_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)

#: First bytes of spreadsheets.
_SPREADSHEETS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")


def read_lines(path: Path) -> list[str]:
    """Return the lines of a text file in UTF-8, UTF-16, UTF-32 or Latin-1.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    TurgorError
        If the file cannot be read, is empty, or is no text.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise TurgorError(f"'{path}' cannot be read: {error.strerror}.") from error
    if data.startswith(_SPREADSHEETS):
        raise TurgorError(f"'{path.name}' is a spreadsheet, not a text file; save its sheet as CSV and read that.")
    encoding = _encoding(data)
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        raise TurgorError(
            f"'{path.name}' begins like a text in {encoding.upper()}, but is damaged at byte {error.start + 1}; "
            "export it again as CSV in UTF-8."
        ) from error
    if "\0" in text:
        raise TurgorError(f"'{path.name}' is no text file (byte 0 occurs in it); export the test as CSV in UTF-8.")
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if not any(line.strip() for line in lines):
        raise TurgorError(f"'{path.name}' is empty; a table needs a header line and rows of numbers.")
    return lines


def csv_rows(path: Path) -> list[tuple[int, list[str]]]:
    """Return the rows of a table with commas and their line numbers, without empty ones; encodings as `read_lines`.

    Raises
    ------
    TurgorError
        If it is no table, such as one whose quotes do not end.
    """
    lines = read_lines(path)
    reader = csv.reader(lines)
    try:
        return [(reader.line_num, row) for row in reader if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise TurgorError(f"'{path}', line {reader.line_num}: this is no table: {error}.") from None


def _encoding(data: bytes) -> str:
    """Encoding of a text: by its mark, by zero bytes at every other place, or by whether the text is valid UTF-8."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return encoding
    start = data[: min(len(data), 2000) // 2 * 2]
    for first, encoding in ((1, "utf-16-le"), (0, "utf-16-be")):
        zeros, others = start[first::2].count(0), start[1 - first :: 2].count(0)
        if len(start) >= 8 and 2 * zeros > len(start) // 2 and others == 0:  # most of every other byte
            return encoding
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"  # older machines write µ and ² in Latin-1
    return "utf-8"
