"""A McKibben muscle: a bladder in a braid of 30 degrees to the axis grows thicker under pressure, and so shorter."""

# %% The bladder with its two stiffer ends; both hands of a braid are mirror images, so that a quarter is enough.
import turgor as tg
from turgor.units import deg, kPa, mm

muscle = tg.actuators.ContractingTube(length=60 * mm)
mesh = tg.mesh(muscle.build(), size=3 * mm, cells="hexahedra")
bladder = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
ends = tg.from_library("smooth-sil-950", record="neo-hooke-polygerinos-2020")


# %% One function for any angle: below 54.7 degrees from the axis a braid shortens the muscle, above it lengthens it.
def shortening(angle: float) -> float:
    """How much of its length the muscle loses at 20 kPa."""
    braid = tg.Fibers(
        face="outside",
        material=tg.from_library("kevlar-fiber"),
        diameter=0.1778 * mm,
        winding=tg.Winding(angle_from_axis=angle, spacing=2 * mm, hand="both"),
    )
    model = tg.Model(
        mesh,
        materials={"body": bladder, "cap": ends},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", 20 * kPa)],
        reinforcements=[braid],
    )
    response = tg.measure(tg.solve(model), tg.measures.tip_displacement_x)
    return float(-response.column("tip_displacement_x")[-1] / muscle.length)


# %%
contracting, extending = shortening(30 * deg), shortening(70 * deg)
print(f"30 deg from the axis: {100 * contracting:.1f} % shorter. 70 deg: {-100 * extending:.1f} % longer.")
assert contracting > 0.03, "a braid below 54.7 deg from the axis contracts"
assert extending < -0.03, "a braid above 54.7 deg from the axis extends"
