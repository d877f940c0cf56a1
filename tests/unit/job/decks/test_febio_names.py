"""What a file of FEBio defines twice, or leaves to another file, is refused: one of the two would be lost."""

import pytest

import turgor as tg
from febio_cases import BRICKS, DOMAIN, POINTS, PULL, SETS, SOFT, feb
from refused import refused

CURVE = '<load_controller id="1" type="loadcurve"><points><pt>0,0</pt><pt>1,-5</pt></points></load_controller>'


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"points": POINTS + '\n<node id="1">5,5,5</node>'}, ['<node id="1">', "another one"]),
        ({"mesh": BRICKS.replace('id="2"', 'id="1"') + SETS}, ['<elem id="1">', "another one"]),
        (
            {"mesh": f'{BRICKS}<Elements type="tet4" name="BLOCK"><elem id="7">1,2,3,5</elem></Elements>{SETS}'},
            ['<Elements name="BLOCK" type="tet4">', "another type"],
        ),
        ({"mesh": f'{BRICKS}{SETS}<NodeSet name="TOP">1,2</NodeSet>'}, ['<NodeSet name="TOP">', "another one"]),
        ({"mesh": BRICKS + SETS + SETS.splitlines()[-1]}, ['<Surface name="LID">', "another one"]),
        ({"material": SOFT + SOFT.replace('id="1"', 'id="2"')}, ['<material id="2"', "another one"]),
        ({"material": SOFT + SOFT.replace("SOFT", "HARD")}, ['name="HARD"', "is '1'"]),
        ({"material": SOFT.replace("<k>", "<G>9</G><k>")}, ["<G>", "the second <G>"]),
        ({"more": f"<LoadData>{CURVE}</LoadData>"}, ['<load_controller id="1"', "another one"]),
        ({"more": '<Boundary from="other.feb"/>'}, ["<Boundary>", "another file"]),
        ({"domains": DOMAIN + "<Include>other.feb</Include>"}, ["<Include>", "another file"]),
        ({"points": f'{POINTS}\n<node id="{10**22}">5,5,5</node>'}, ["<node", "2147483647"]),
    ],
)
def test_what_would_be_lost_is_refused(tmp_path, changes, facts):
    with refused("block.feb", *facts):
        tg.files.import_deck(feb(tmp_path, **changes))


def test_a_node_set_may_have_the_name_of_all_nodes(tmp_path):
    mesh = BRICKS + SETS + '<NodeSet name="all">9,10</NodeSet>'
    pull = '<nodal_load node_set="all" type="nodal_force"><value lc="1">1,0,0</value></nodal_load>'
    assert tg.files.import_deck(feb(tmp_path, mesh=mesh, loads=PULL + pull))
