"""Files of FEBio for tests: the block of two bricks of `deck_cases`, with elements of a test where files have them."""

from pathlib import Path

from deck_cases import NODES

#: The nodes of the deck, and two bricks.
POINTS = "\n".join(f'<node id="{row.split(",", 1)[0]}">{row.split(",", 1)[1]}</node>' for row in NODES.splitlines()[1:])

BRICKS = """\
<Elements type="hex8" name="BLOCK">
<elem id="1">1,2,3,4,5,6,7,8</elem>
<elem id="2">5,6,7,8,9,10,11,12</elem>
</Elements>
"""

SETS = """\
<NodeSet name="BOTTOM">1,2,3,4</NodeSet>
<NodeSet name="TOP"><n id="9"/><n id="10"/><n id="11"/><n id="12"/></NodeSet>
<Surface name="LID"><quad4 id="1">9,10,11,12</quad4></Surface>
"""

SOFT = '<material id="1" name="SOFT" type="incomp neo-Hookean"><G>0.2</G><k>5</k></material>'

FIXED = (
    '<bc name="floor" node_set="BOTTOM" type="zero displacement"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc>'
)

PULL = '<surface_load surface="LID" type="pressure"><pressure lc="1">-0.03</pressure><linear>0</linear></surface_load>'

RISE = "<interpolate>LINEAR</interpolate><points><pt>0,0</pt><pt>1,1</pt></points>"

DOMAIN = '<SolidDomain name="BLOCK" mat="SOFT"/>'


def feb(
    folder: Path,
    *,
    material: str = SOFT,
    mesh: str = BRICKS + SETS,
    points: str = POINTS,
    domains: str = DOMAIN,
    boundary: str = FIXED,
    loads: str = PULL,
    curve: str = RISE,
    more: str = "",
    control: str = "<analysis>STATIC</analysis>",
    module: str = '<Module type="solid"/>',
) -> Path:
    """Write a file of the block."""
    file = folder / "block.feb"
    file.write_text(
        f"""<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="4.0">
{module}
<Control>{control}<time_steps>10</time_steps><step_size>0.1</step_size></Control>
<Globals><Constants><T>0</T></Constants></Globals>
<Material>
{material}
</Material>
<Mesh>
<Nodes name="all">
{points}
</Nodes>
{mesh}
</Mesh>
<MeshDomains>{domains}</MeshDomains>
<Boundary>
{boundary}
</Boundary>
<Loads>
{loads}
</Loads>
{more}
<LoadData>
<load_controller id="1" type="loadcurve">{curve}</load_controller>
</LoadData>
<Output><plotfile type="febio"/></Output>
</febio_spec>
""",
        encoding="utf-8",
    )
    return file
