"""Files of strangers: damaged, encrypted, nested or enormous ones get a sentence before memory is taken."""

import io
import json
import os
import struct
import zlib
from base64 import b64encode
from contextlib import suppress
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry.cad.files import reading
from turgor.core.geometry.cad.read import read_here
from turgor.core.geometry.cad.stl import read_stl
from turgor.core.geometry.cad.surface.repair import repaired
from turgor.core.meshing.exchange.formats.abaqus import read_abaqus
from turgor.core.meshing.exchange.formats.vtu import read_vtu
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import PART, write_whole

HEAD = {"format": "turgor", "version": 1, "written_by": "turgor 0.1.0", "kind": "Response"}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "a.turgor"


@pytest.fixture
def saved(file: Path) -> bytes:
    values = np.linspace(0, 1, 200)
    Response(columns=(Column("pressure", "kPa", values),), source=Source(text="a test")).save(file)
    return file.read_bytes()


def archive(file: Path, content: str, arrays: bytes = b"", compressed: bool = False) -> None:
    with ZipFile(file, "w", ZIP_DEFLATED if compressed else 0) as made:
        made.writestr("content.json", content)
        if arrays:
            made.writestr("arrays/a0.npy", arrays)


def test_missing_bytes_are_told(file, saved):
    random = np.random.default_rng(0)
    for _ in range(60):
        start, length = int(random.integers(len(saved))), int(random.integers(1, 400))
        file.write_bytes(saved[:start] + saved[start + length :])
        with pytest.raises(TurgorError):
            tg.load(file)


def test_damaged_bytes_are_told_or_harmless(file, saved):
    random = np.random.default_rng(1)
    for _ in range(200):
        damaged = bytearray(saved)
        for place in random.integers(len(saved), size=3):
            damaged[place] = random.integers(256)
        file.write_bytes(bytes(damaged))
        with suppress(TurgorError):
            tg.load(file)


@pytest.mark.parametrize("nested", [900, 100_000])
def test_nested_content_is_told(file, nested):
    archive(file, json.dumps(HEAD)[:-1] + f', "content": {"[" * nested}{"]" * nested}}}')
    with refused(file, "damaged"):
        tg.load(file)


def test_what_unpacks_to_gigabytes_is_refused(file, monkeypatch):
    archive(file, json.dumps(HEAD | {"content": " " * 300_000_000}), compressed=True)
    assert file.stat().st_size < 1_000_000
    with refused(file, "300 MB", "200 MB", "TURGOR_UNPACKED_MB"):
        tg.load(file)


def test_a_header_that_asks_for_more_than_follows_is_refused(file):
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<f8", "fortran_order": False, "shape": (10**15,)})
    archive(file, json.dumps(HEAD | {"content": {"array": "a0"}}), header.getvalue() + bytes(80))
    with refused("arrays/a0.npy", "8000000000000000 bytes", 80):
        tg.load(file)


def test_another_limit_can_be_stated(file, monkeypatch):
    archive(file, json.dumps(HEAD | {"content": " " * 3_000_000}), compressed=True)
    monkeypatch.setenv("TURGOR_UNPACKED_MB", "2")
    with refused(file, "3 MB", "2 MB", "TURGOR_UNPACKED_MB"):
        tg.load(file)


@pytest.mark.parametrize(
    "name",
    ["os:system", "subprocess:Popen", "pty:spawn", "turgor.foundation.startup.background_compiler:subprocess.Popen"],
)
def test_only_classes_of_turgor_are_made(file, name):
    """A file names classes; those of others count where the program has loaded them, and are never called."""
    called: list[object] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("subprocess.Popen.__init__", lambda *given, **_: called.append(given))
        archive(file, json.dumps(HEAD | {"content": {"object": name, "fields": {"args": ["touch", "PWNED"]}}}))
        with pytest.raises(TurgorError):
            tg.load(file)
    assert not called


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_link_with_the_name_of_a_part_is_not_followed(tmp_path):
    """Who can write into the folder knows the names of the parts that a process writes."""
    (tmp_path / "theirs").write_text("theirs")
    for name in (f"a.txt{PART}", f"a.txt.{os.getpid()}{PART}"):
        (tmp_path / name).symlink_to(tmp_path / "theirs")
    write_whole(tmp_path / "a.txt", "mine")
    assert (tmp_path / "theirs").read_text() == "theirs"
    assert (tmp_path / "a.txt").read_text() == "mine"


def test_a_file_is_on_disk_before_it_has_its_name(tmp_path, monkeypatch):
    done = []
    monkeypatch.setattr("turgor.foundation.store.atomic_files.os.fsync", lambda number: done.append("written"))
    real = os.replace
    monkeypatch.setattr(
        "turgor.foundation.store.atomic_files.os.replace", lambda *paths: (done.append("named"), real(*paths))
    )
    write_whole(tmp_path / "a.txt", "mine")
    assert done == ["written", "named"]


def test_a_damaged_header_of_an_array_is_told(file):
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<f8", "fortran_order": False, "shape": (2,)})
    damaged = header.getvalue().replace(b"}", b"(")
    archive(file, json.dumps(HEAD | {"content": {"array": "a0"}}), damaged + bytes(16))
    with refused(file, "damaged"):
        tg.load(file)


@pytest.mark.parametrize(
    ("old", "new", "fact"),
    [('"kPa"', '["kPa"]', "Column"), ('"kPa"', '"kPx"', "'kPx'"), ('{"array": "a0"}', '"a0"', "Column")],
)
def test_values_of_another_kind_are_told(file, saved, old, new, fact):
    with ZipFile(file) as made:
        content, array = made.read("content.json").decode(), made.read("arrays/a0.npy")
    assert old in content
    archive(file, content.replace(old, new), array)
    with refused(file, fact):
        tg.load(file)


def test_an_encrypted_file_is_told(file, saved):
    marked = bytearray(saved)
    for place in range(len(marked) - 4):
        if marked[place : place + 4] == b"PK\x03\x04":
            marked[place + 6] |= 1
        elif marked[place : place + 4] == b"PK\x01\x02":
            marked[place + 8] |= 1
    file.write_bytes(bytes(marked))
    with refused(file, "content.json", "encrypted"):
        tg.load(file)


def test_a_newer_version_is_told_once(file):
    archive(file, json.dumps(HEAD | {"version": 2, "written_by": "turgor 9.0", "content": None}))
    with refused(f"'{file}'", "turgor 9.0", "version 2", "version 1"):
        tg.load(file)


def test_a_vtu_file_that_unpacks_to_gigabytes_is_refused(tmp_path):
    block = zlib.compress(bytes(10_000_000))
    header = struct.pack("<6I", 3, 1_500_000_000, 0, *(3 * [len(block)]))
    data = (b64encode(header) + b64encode(3 * block)).decode()
    (tmp_path / "bomb.vtu").write_text(
        '<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt32" '
        'compressor="vtkZLibDataCompressor"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1"><Points>'
        f'<DataArray type="Float64" NumberOfComponents="3" format="binary">{data}</DataArray></Points>'
        '<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>'
        '<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>'
        '<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>'
        "</Piece></UnstructuredGrid></VTKFile>"
    )
    with refused("bomb.vtu", "4.5e+03 MB", "200 MB"):
        read_vtu(tmp_path / "bomb.vtu")


def test_a_soup_of_triangles_is_refused():
    """It took minutes, because each shell was compared with each other one."""
    with refused("soup.stl", "300 shells", 200):
        repaired(np.random.default_rng(0).random((300, 3, 3)), "soup.stl")


def test_a_surface_around_nothing_is_refused(tmp_path):
    """Each of these triangles is a hole with a plane rim, and was closed by itself."""
    corners = 30 * np.random.default_rng(0).random((3, 3, 3))
    header = bytes(80) + struct.pack("<I", 3)
    facets = b"".join(np.concatenate([np.zeros(3), c.ravel()]).astype("<f4").tobytes() + bytes(2) for c in corners)
    (tmp_path / "soup.stl").write_bytes(header + facets)
    with refused("soup.stl", "volume", "mm³"):
        read_here(tmp_path / "soup.stl")


def test_reading_of_a_small_shape_ends_within_a_minute(tmp_path):
    for ending, begin in (("step", b"ISO-10303-21;"), ("brep", b"DBRep_DrawableShape"), ("stl", b"solid")):
        (tmp_path / f"part.{ending}").write_bytes(begin + bytes(10_000))
        assert reading(tmp_path / f"part.{ending}").limit <= 60
    (tmp_path / "part.stl").write_bytes(bytes(1_000_000))
    assert reading(tmp_path / "part.stl").limit > 300


@pytest.mark.parametrize(
    ("name", "facts"), [("/dev/zero", ["'/dev/zero'", "file"]), ("deck.inp", ["'deck.inp'", "includes 'deck.inp'"])]
)
def test_what_a_mesh_file_includes_is_a_file_and_not_itself(tmp_path, name, facts):
    (tmp_path / "deck.inp").write_text(f"*INCLUDE, INPUT={name}\n")
    with refused("deck.inp", *facts):
        read_abaqus(tmp_path / "deck.inp")


def test_a_text_stl_with_no_number_is_told(tmp_path):
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    lost = facet.replace("vertex 0 0 0", "vertex nan 0 0").replace("vertex 1 0 0", "vertex nan 0 0")
    lost = lost.replace("vertex 0 1 0", "vertex 0 nan 0")
    (tmp_path / "part.stl").write_text(f"solid part\n{facet}{lost}endsolid\n")
    with refused("part.stl", "finite"):
        read_stl(tmp_path / "part.stl")


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_a_binary_stl_with_no_number_is_refused(tmp_path, number):
    facet = np.zeros(1, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facet["corners"][0, 1, 2] = number
    (tmp_path / "part.stl").write_bytes(bytes(80) + (1).to_bytes(4, "little") + facet.tobytes())
    with refused("part.stl", "finite"):
        read_stl(tmp_path / "part.stl")
