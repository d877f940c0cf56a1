"""Command ``turgor cache``: what is cached, where, and how much it is; empty it."""

from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Debug


def cache_command(
    clear: Annotated[
        bool, typer.Option("--clear", help="Empty all caches; they are filled again when needed.")
    ] = False,
    debug: Debug = False,
) -> None:
    """Show the caches and their sizes, or empty them."""
    with errors_as_sentences(debug):
        from turgor.foundation.startup.kernel_folder import compiled_files
        from turgor.foundation.store.caches import PARTS, caches

        files_of = {part: _files(caches() / part) for part in PARTS}
        files_of["compiled"] += [file for file in compiled_files() if file not in files_of["compiled"]]
        typer.echo(f"Caches in {caches()}:")
        for part, files in files_of.items():
            size = sum(_size(file) for file in files) / 1e6
            typer.echo(f"  {part:10}{len(files):>7} files{size:>10.1f} MB  {PARTS[part]}")
        if clear:
            removed = sum(_removed(file) for files in files_of.values() for file in files)
            typer.echo(f"{removed} files removed.")
        raise typer.Exit(DONE)


def _files(folder: Path) -> list[Path]:
    """Files of a cache; links in it are not followed."""
    if folder.is_symlink() or not folder.is_dir():
        return []
    return [file for file in sorted(folder.rglob("*")) if file.is_file() and not file.is_symlink()]


def _size(file: Path) -> int:
    try:
        return file.stat().st_size
    except OSError:  # another process has removed it
        return 0


def _removed(file: Path) -> bool:
    try:
        file.unlink()
    except OSError:
        return False
    return True
