"""Files that a page sends: what cannot be read is refused with a sentence, and nothing of it stays."""

import base64
import http.client
import json
import os
import struct
import zipfile
import zlib
from io import BytesIO
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pytest
from served import served

from turgor.foundation.errors import TurgorError
from turgor.studio.routes.uploads import stored_name
from turgor.studio.settings import STUDIO

EXAMPLES = Path(__file__).parents[3] / "examples"
STEP = (EXAMPLES / "cad_file.step").read_bytes()
STL = (EXAMPLES / "print.stl").read_bytes()


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    with served(tmp_path_factory.mktemp("uploads")) as running:
        yield running


def send(studio, name: str, body: bytes, headers=()) -> tuple[int, dict]:
    """Send a file as a page of the studio does; return the status and the answer."""
    connection = http.client.HTTPConnection("127.0.0.1", studio.port, timeout=300)
    try:
        connection.request("GET", f"/?token={studio.token}")
        cookie = connection.getresponse()
        cookie.read()
        marks = {"Origin": studio.origin, "Cookie": cookie.headers["set-cookie"].split(";")[0], **dict(headers)}
        connection.request("POST", f"/api/uploads?name={quote(name, safe='')}", body, marks)
        answer = connection.getresponse()
        return answer.status, json.loads(answer.read())
    finally:
        connection.close()


def files(studio) -> set[str]:
    """All files of the folder, those of the studio itself included."""
    return {str(each.relative_to(studio.workspace)) for each in studio.workspace.rglob("*") if each.is_file()}


def noise(count: int) -> bytes:
    return np.random.default_rng(3).integers(0, 256, count, dtype=np.uint8).tobytes()


def soup() -> bytes:
    """A binary STL of triangles that belong to nothing."""
    corners = np.random.default_rng(5).normal(size=(400, 9)).astype("<f4")
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *row, 0) for row in corners)
    return bytes(80) + struct.pack("<I", len(corners)) + body


def bomb() -> bytes:
    """A VTU file whose block of 30 kB declares and holds 30 MB of zeros, many times more than it has points."""
    raw = bytes(30_000_000)
    packed = zlib.compress(raw, 9)
    head = struct.pack("<4I", 1, len(raw), 0, len(packed))
    data = base64.b64encode(head).decode() + base64.b64encode(packed).decode()
    return f"""<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<UnstructuredGrid><Piece NumberOfPoints="4000000000" NumberOfCells="4000000000">
<Points><DataArray type="Float64" NumberOfComponents="3" format="binary">{data}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="binary">{data}</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>""".encode()


def laughs() -> bytes:
    """An XML file whose entities would expand to a billion."""
    entities = "".join(f'<!ENTITY l{k} "{f"&l{k - 1};" * 10}">' for k in range(1, 10))
    return f'<?xml version="1.0"?><!DOCTYPE d [<!ENTITY l0 "lol">{entities}]><VTKFile>&l9;</VTKFile>'.encode()


def zipped() -> bytes:
    with BytesIO() as out:
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("finger.step", bytes(10_000_000))
        return out.getvalue()


GMSH = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {count} 1 {count}\n3 1 0 {count}\n1\n0 0 0\n$EndNodes\n"

#: Names and contents that must be refused, with a word of the sentence.
MALFORMED = {
    "cut": ("finger.step", STEP[: len(STEP) // 3], "finger.step"),
    "cut in a number": ("finger.step", STEP[:-4000], "finger.step"),
    "no end": ("finger.stp", STEP.replace(b"ENDSEC", b""), "finger.stp"),
    "numbers are words": ("finger.step", STEP.replace(b"0.", b"zero."), "finger.step"),
    "noise as STEP": ("noise.step", noise(50_000), "noise.step"),
    "noise as STL": ("noise.stl", noise(50_000), "noise.stl"),
    "noise as BREP": ("noise.brep", noise(50_000), "noise.brep"),
    "noise as gmsh": ("noise.msh", noise(50_000), "noise.msh"),
    "soup": ("soup.stl", soup(), "soup.stl"),
    "STL with a huge count": ("huge.stl", STL[:80] + struct.pack("<I", 4_000_000_000) + STL[84:], "huge.stl"),
    "cut STL": ("cut.stl", STL[: len(STL) // 2 + 7], "cut.stl"),
    "gmsh with a huge count": ("huge.msh", GMSH.format(count=4_000_000_000).encode(), "huge.msh"),
    "bomb": ("bomb.vtu", bomb(), "bomb.vtu"),
    "laughs": ("laughs.vtu", laughs(), "laughs.vtu"),
    "Abaqus without elements": ("bare.inp", b"*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n", "bare.inp"),
    "archive": ("finger.zip", zipped(), "allowed are .step"),
    "archive that is called STEP": ("finger.step", zipped(), "finger.step"),
    "program": ("finger.step.exe", STEP, "allowed are .step"),
    "way out": ("../finger.step", STEP, "no name of a file"),
    "way out of Windows": ("..\\..\\finger.step", STEP, "no name of a file"),
    "hidden": (".finger.step", STEP, "no name of a file"),
    "no name": ("", STEP, "no name of a file"),
    "empty": ("empty.step", b"", "is empty"),
    "job that is no TOML": ("job.toml", b"[actuator\nwall = ", "no TOML"),
    "job without an actuator": ("job.toml", b"answer = 42\n", "no table [actuator]"),
}


@pytest.mark.parametrize("kind", MALFORMED)
def test_malformed_file_is_refused_and_leaves_nothing(studio, kind):
    name, body, word = MALFORMED[kind]
    before = files(studio)
    status, answer = send(studio, name, body)
    assert status == 400, answer
    assert word in answer["error"]
    assert str(studio.workspace) not in answer["error"]
    assert files(studio) - before <= {".turgor-studio/.gitignore"}
    assert not list((studio.workspace / ".turgor-studio").glob("uploads/*"))


def test_file_over_the_limit_is_refused_before_it_is_read(studio):
    before = files(studio)
    status, answer = send(studio, "large.step", b"", {"Content-Length": str(STUDIO.upload_bytes + 1)}.items())
    assert status == 413
    assert "more than 100 MB" in answer["error"]
    assert files(studio) - before <= {".turgor-studio/.gitignore"}


def test_file_that_does_not_state_its_size_is_refused_at_the_limit(studio):
    before = files(studio)

    def pieces():
        for _ in range(STUDIO.upload_bytes // 1_000_000 + 1):
            yield bytes(1_000_000)

    status, answer = send(studio, "large.stl", pieces())
    assert status == 413
    assert "more than 100 MB" in answer["error"]
    assert files(studio) - before <= {".turgor-studio/.gitignore"}


def test_part_is_stored_under_a_plain_and_free_name(studio):
    for name in ("My print (1).STL", "my-print-1.stl"):
        status, answer = send(studio, name, STL)
        assert status == 200, answer
        assert (studio.workspace / answer["name"]).read_bytes() == STL
        assert answer["unit"] is False
        assert answer["size"] == pytest.approx([0.05, 0.016, 0.008])
    assert {"My-print-1.stl", "my-print-1.stl"} <= files(studio)
    status, answer = send(studio, "my-print-1.stl", STL)
    assert answer["name"] == "my-print-1-2.stl"


def test_job_file_is_stored_as_it_is(studio):
    text = (EXAMPLES / "fast_pneunet.toml").read_bytes()
    status, answer = send(studio, "finger.toml", text)
    assert (status, answer) == (200, {"name": "finger.toml", "kind": "job"})
    assert (studio.workspace / "finger.toml").read_bytes() == text


def test_upload_of_a_killed_server_is_removed(studio):
    left = studio.workspace / ".turgor-studio" / "uploads" / "left"
    left.mkdir(parents=True)
    (left / "large.step").write_bytes(b"half")
    os.utime(left, (0, 0))
    send(studio, "finger.toml", (EXAMPLES / "fast_pneunet.toml").read_bytes())
    assert not left.exists()


@pytest.mark.parametrize("name", ["a/b.step", "a\\b.step", "..", "a.step\n", "a\0.step", "a.exe", ".step", "a"])
def test_names_that_are_refused(name):
    with pytest.raises(TurgorError):
        stored_name(name)


def test_names_become_plain():
    assert stored_name("Finger für Ärzte.STP") == "Finger-f-r-rzte.stp"
    assert stored_name("é.stl") == "part.stl"
    assert len(stored_name("x" * 500 + ".stl")) < 100
