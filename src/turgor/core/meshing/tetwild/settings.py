"""Settings of fTetWild: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TetwildSettings:
    """How rough surfaces are filled with tetrahedra, whose nodes are then moved onto the surface (`test_enveloped`).

    Parameters
    ----------
    envelope_per_size, envelope_per_wall : float
        Width of the envelope over the size of the cells, and over the thinnest wall; the smaller one counts.
    stop_energy : float
        Energy of the worst cell at which fTetWild stops; a regular tetrahedron has 3. Its own default, 10, takes two to
        three times as long.
    background_points : int
        Most points of the lattice that carries the sizes.
    crumb : float
        A lone group of cells smaller than this share of the part is dropped.
    reach : float
        A node moves by at most this many times the width of the envelope; what is further away is another part.
    least_volume : float
        A cell keeps at least this share of its volume when its corners move; else they go back.
    candidates : int
        Samples of the surface that are looked at around a point, so many that the nearest triangle is among theirs.
    """

    envelope_per_size: float = 0.05
    envelope_per_wall: float = 0.1
    stop_energy: float = 20.0
    background_points: int = 60_000
    crumb: float = 0.01
    reach: float = 3.0
    least_volume: float = 0.3
    candidates: int = 24


TETWILD = TetwildSettings()
