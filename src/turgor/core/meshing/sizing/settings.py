"""Settings of mesh sizes: every number that was chosen, with its reason.

Lengths are shares of the mesh size unless another one is stated.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from types import MappingProxyType


@dataclass(frozen=True, slots=True)
class SizingSettings:
    """Sizes by default, the allowed ones, and the unknowns that they make (`test_sizes`, and the truth cases).

    Parameters
    ----------
    cells_per_extent : float
        Without a given size, the part is at least this many cells long.
    tetrahedra_per_wall, hexahedra_per_wall : float
        Without a given size, cells are this many times longer than the thinnest wall is thick; elements of a meridian
        as tetrahedra. With hexahedra four times as long, an eccentric bender was 3 % off and ring sectors 6 %; three
        times, 0.3 % and 1 %.
    largest_per_wall : float
        Cells up to this many times longer than the thinnest wall suit all walls: one quadratic cell through a wall,
        four times as long as thick, still bends well; longer cells miss the bulging of walls.
    default_unknowns, most_unknowns : float
        Largest mesh that is made where neither size nor quality is stated, which one machine solves in minutes, and
        that one machine can be expected to solve.
    unknowns_of_pairs : float
        Hexahedra of a section that is cut into paired triangles are not chosen where they have more unknowns. A long
        bender with a skin has 150,000, and 80,000 with tetrahedra, which are 0.3 % off on the truth set.
    free_middles : float
        Hexahedra of a sweep have middles of sides and cells with unknowns of their own up to so many unknowns. Beyond,
        middles follow the other nodes, which leaves six tenths of the unknowns and half of the time; on the same mesh
        errors are up to twice as large, but large meshes have small ones (`benchmarks/choices.md`).
    short_cells : float
        Beyond so many unknowns after that, there are no short cells next to feature lines. A revolute joint with 48,443
        unknowns is 0.7 % off with them, and 2.1 % without.
    row : float
        Both limits for chambers in a row, whose sections are grids. Beyond the first one, sections have short cells
        next to their outer walls alone: five chambers at 12 kPa take 17 CPU s with 21,891 unknowns, 34 with 45,037 of
        free middles and short cells everywhere, and are not further off. The demo finger takes 53 with 36,812 unknowns
        and no short cells, 71 with 41,619 and those along its path, 106 with 48,243 and those at its outer walls.
    unknowns_per_volume, unknowns_per_area : float
        Unknowns per volume over size cubed, measured on the fast PneuNet from 1.5 to 1 mm: 40 to 35; and per area over
        size squared that a face with a size of its own adds, measured on its cavity from 1 to 0.5 mm: 15 to 19.
    cells_per_radius : float
        Cells along an arc as long as its radius. With 1, curved cells turn inside out where a fillet or a tube is
        coarse (a slot of 1 mm radius at 1 mm size: 3 cells); with 2, none did on slots, tubes, half tubes and spheres.
    wall_cells : int
        Most cells through a wall that can be requested.
    least_target, most_target : float
        Relative mesh errors that can be requested.
    short, growth : float
        Length of the cells next to a feature line, such as the inner side of a wall or a thin corner; cells grow away
        from it by at most this factor each (`test_swept_sections`). On a rectangular bender of 50 mm with a base 20
        times stiffer, size three times the wall, the angle is 1.6 % off with cells of equal length, 0.1 % with these
        and a quarter more unknowns.
    hinge : float
        Length of the cells at corners about which walls fold, as a share of the size. Bellows of four straight folds
        extend 14 % too little without short cells there, 0.8 % with these, in 12 CPU s; a third longer, 1.0 % in 9 s.
    tube_edge, tube_along : float
        Length of the cells along the inner edges of a straight tube of rectangular section, and along the tube, over
        the size. A rectangular bender is 2.7 % off with cells as elsewhere, 0.5 % with these.
    tube_cells : int
        Cells through the walls of such a tube with several chambers in its section. The stress of a bidirectional
        bender (99 %) is 5.4 % off with two, 2.6 % with three whose middles follow, in 16 instead of 22 CPU s.
    block_edge : float
        Length of the cells at the walls of chambers in a block, over the size, where that needs no more than
        `short_cells` unknowns. Four chambers in a block are 1.2 % (tip) and 4.4 % (stress) off with the third of
        `short`, where most walls are one cell thick; with these, 0.6 and 0.2 %, in 8 instead of 2 CPU s.
    short_row : float
        Largest cells of a short row of slanted chambers, or of chambers on both sides of a layer, over the size; short
        ones stand at outer walls, and middles follow. Three helical chambers are 0.8 % (angle) and 3.7 % (stress) off
        with cells as elsewhere, 0.8 and 1.4 % with these, in 15 instead of 21 CPU s; three bidirectional ones 0.7 and
        4.2 %, 0.4 and 0.4 % with these, in 7 instead of 5 CPU s.
    curved : float
        Size on curved walls that end in thin corners: a share of the size and not of the wall, so that a study of mesh
        sizes refines all of a mesh alike.
    folded : float
        Size on the folded walls of bellows, over the mesh size: 0.7 leaves three parallel bellows 3 % off.
    film_sides, most_film_sides : float
        Sides of a film without a solid along its longest extent, by default and at most. A Kresling
        tube takes 28 CPU s with 9.5; the path of a pouch ends at its first step with 11.
    """

    cells_per_extent: float = 8.0
    tetrahedra_per_wall: float = 2.0
    hexahedra_per_wall: float = 3.0
    largest_per_wall: float = 4.0
    default_unknowns: float = 1.5e5
    most_unknowns: float = 3e6
    unknowns_of_pairs: float = 1e5
    free_middles: float = 6e4
    short_cells: float = 5e4
    row: float = 3e4
    unknowns_per_volume: float = 40.0
    unknowns_per_area: float = 20.0
    cells_per_radius: float = 2.0
    wall_cells: int = 4
    least_target: float = 1e-4
    most_target: float = 0.5
    short: float = 1 / 3
    growth: float = 4.0
    hinge: float = 2 / 45
    tube_edge: float = 1 / 9
    tube_along: float = 2.0
    tube_cells: int = 3
    block_edge: float = 1 / 6
    short_row: float = 0.76
    curved: float = 0.7
    folded: float = 0.5
    film_sides: float = 9.5
    most_film_sides: float = 400.0


SIZING = SizingSettings()


@dataclass(frozen=True, slots=True)
class QualitySettings:
    """What a requested quality means where no size is stated (`test_requested_quality`).

    Parameters
    ----------
    error : float
        Relative mesh error of angles, extensions, twists and volumes that the quality is made for.
    size : float
        Factor of the size of "normal". Tetrahedra of 1.5 times that size are up to 9 % off on the truth set (one tip
        11 %), but 21 % on a fin; of 1.25 times, 13 % there. Hexahedra of half the size are 0.5 % off.
    row : float
        Further factor of the size of hexahedra for chambers in a row, whose sections are grids; `SIZING.row` is divided
        by its square, and cells may be longer than four times their wall. With 1.6 the demo finger takes 27 CPU s
        (normal: 51) and bends by 1.6 % less, five chambers 8 (17) and 3.5 %; three of two and three chambers,
        1 to 2 s and 2.6 to 4.8 %. Tetrahedra of a draft took 80 and 20 s.
    unknowns : float
        Factor of the unknowns above which cells get longer.
    hexahedra : float
        Hexahedra are chosen where they suit a geometry and have at most so many unknowns in a "normal" mesh, and for
        chambers in a row. Up to 40,000, tetrahedra of a draft have as many in half of the families, and are worse.
    """

    error: float
    size: float = 1.0
    row: float = 1.0
    unknowns: float = 1.0
    hexahedra: float = inf


#: Qualities by name, the coarsest first.
QUALITIES: Mapping[str, QualitySettings] = MappingProxyType(
    {
        "draft": QualitySettings(0.1, size=1.25, row=1.6, hexahedra=4e4),
        "normal": QualitySettings(0.02),
        "fine": QualitySettings(0.005, size=0.5, unknowns=4.0),
    }
)


@dataclass(frozen=True, slots=True)
class ThinWallSettings:
    """How a mesh is made again where its edges are too long for a wall (`test_thin_walls`).

    Parameters
    ----------
    longest_per_wall : float
        Longest edge over thickness of a wall that is accepted. The largest size is four times the wall, and the
        generator makes some edges half as long again as the size it is given.
    requested_per_wall, firmer, rounds : float, float, int
        Size requested there over the thickness at first, its factor each time that this did not suffice, and how often
        it is tried.
    """

    longest_per_wall: float = 6.0
    requested_per_wall: float = 3.0
    firmer: float = 0.7
    rounds: int = 3


THIN_WALLS = ThinWallSettings()


@dataclass(frozen=True, slots=True)
class FeatureSettings:
    """Which small features cells need not follow (`test_small_features`).

    Parameters
    ----------
    coarse_radius : float
        By themselves, smaller radii are left coarse: one cell reaches over an arc of a quarter circle. Where a limit is
        stated, edges shorter than this share of it are left out; arcs of fillets are longer than their radius.
    unknowns : float
        By themselves, they are left coarse only where cells along them would make more unknowns than this, and more
        than the rest of the part.
    turned : float
        A round that turns by less than this angle (cosine of 120°) is a fillet, which one cell reaches over; what turns
        further is a hole or a boss, which gets six cells around it. Two edges that meet at more than this angle lead to
        the two sides of a wall.
    fewer : float
        A mesh that does not keep their edges is taken if it has at most this share of the unknowns of one that does:
        its cells are less regular.
    """

    coarse_radius: float = 0.5
    unknowns: float = 2e4
    turned: float = -0.5
    fewer: float = 0.7


FEATURES = FeatureSettings()
