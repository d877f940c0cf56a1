"""Settings of the studio: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StudioSettings:
    """Limits and times of the server.

    Parameters
    ----------
    port : int
        Port that is tried first; a free one where it is taken.
    upload_bytes : int
        Largest file that a page may send [bytes]: a detailed STEP file has 20 MB.
    body_bytes : int
        Largest request otherwise [bytes]: a job file has some kilobytes.
    watch : float
        Time between two looks at the folder [s]: shorter than what a person notices as late.
    idle : float
        Time after which an unused worker ends [s], because it has 200 MB.
    patience : float
        Longest time of a task of the worker [s]; a mesh of a large part takes a minute.
    cancel : float
        Time that a run has to end by itself before it is killed [s]; its states are on disk.
    look : float
        Time between two looks at a process that ends [s].
    impatient : float
        Time after which a check of an older text is killed for that of a newer one [s]: a new process needs as long to
        begin.
    lines : int
        Lines of a log that the page shows.
    undo : int
        Edits of a file that can be undone.
    """

    port: int = 8765
    upload_bytes: int = 100_000_000
    body_bytes: int = 2_000_000
    watch: float = 0.4
    idle: float = 300.0
    patience: float = 300.0
    cancel: float = 0.8
    look: float = 0.02
    impatient: float = 2.0
    lines: int = 60
    undo: int = 200


STUDIO = StudioSettings()


@dataclass(frozen=True, slots=True)
class LiveSettings:
    """Settings of the window in which a reduced model moves.

    Parameters
    ----------
    frames : int
        States at the ends of the ranges that the picture has room for.
    flat : float
        Share of the travel of the tip that it may be out of a plane to count as moving in one.
    updates : int
        Updates of the search while the tip is dragged: the next ones follow with the next place of the mouse.
    rest : float
        Time without a change after which all measures are read off [s]; reading takes longer than a frame.
    rows : float
        Time between two rows of a saved sequence [s].
    longest : float
        Longest sequence [s], whose states take a minute.
    """

    frames: int = 8
    flat: float = 1e-3
    updates: int = 4
    rest: float = 0.2
    rows: float = 0.05
    longest: float = 600.0


LIVE = LiveSettings()


@dataclass(frozen=True, slots=True)
class FittingSettings:
    """Settings of the screen of materials.

    Parameters
    ----------
    points : int
        Points of a curve and of a thinned test, as `turgor fit` has.
    curves : int
        Curves in one picture at most: as many as there are colors that can be distinguished.
    most : float
        Largest stretch of a curve [-]: beyond it no law of the library was tested.
    laws : int
        Laws in one comparison at most; each takes some seconds.
    """

    points: int = 60
    curves: int = 8
    most: float = 10.0
    laws: int = 12


FITTING = FittingSettings()
