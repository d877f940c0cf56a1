"""Whole files that are damaged: jobs with most of the tables that a job can have, studies and a table of designs."""

FULL = """\
name = "full"

[actuator]
type = "extending_cylinder"
length = "30 mm"
symmetric = false

[mesh]
size = "4 mm"
cells = "tetrahedra"
face_sizes = { cavity = "3 mm" }
wall_cells = 1

[materials.body]
law = "yeoh"
C10 = "0.11 MPa"
C20 = "0.02 MPa"
density = "1.07 g/cm³"
source = { text = "our own test" }

[fibers.hoops]
face = "outside"
library = "kevlar-fiber"
angle_from_circumference = "0 deg"
spacing = "2 mm"
within = { x_from = "1 mm" }

[supports]
fixed = "xyz"

[loads.cavity]
pressure = "20 kPa"
history = [[0, 0], [0.5, 1], [1, 0.5]]

[loads.gravity]
direction = "-z"

[obstacles.plate]
shape = "plane"
point = ["50 mm", 0, 0]
normal = "-x"
friction = 0.3

[procedure]
type = "static"
first_step = 0.25
max_step = 0.5

[output]
measures = ["tip_displacement_x", "cavity_volume"]
fields = false

[engine]
threads = 1
"""

STAGED = """\
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"

[mesh]
size = "4 mm"

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[contact]
self_contact = true

[[stages]]
name = "fill"
loads = { cavity = { pressure = "2 kPa" } }
procedure = { type = "static" }

[[stages]]
name = "swing"
loads = { cavity = { pressure = "1 kPa", history_over_time = [[0, 0], [1, 1]] } }
procedure = { type = "dynamic", duration = "1 s" }
"""

STUDY = """\
name = "walls"
job = "job.toml"

[factors]
actuator.length = ["25 mm", "30 mm"]
materials.body.C10 = { low = "0.1 MPa", high = "0.12 MPa" }

[sweep]
design = "sobol"
samples = 8
seed = 1
measures = ["tip_displacement_x", "cavity_volume"]
at = { pressure = "10 kPa" }
mesh_error = false

[surrogate]
along = "pressure"
"""

TABLE_STUDY = """\
job = "job.toml"

[sweep]
design = "table"
table = "designs.csv"
"""

OPTIMIZATION = """\
job = "job.toml"

[factors]
"actuator.length" = { low = "20 mm", high = "40 mm", start = "30 mm" }
"materials.body.C10" = { low = "0.1 MPa", high = "0.2 MPa", spread = "5 %" }

[optimize]
precision = 0.02
targets = [{ measure = "tip_displacement_x", value = "4 mm" }]
limits = [{ measure = "von_mises_p99", most = "0.13 MPa" }]
objectives = [{ minimize = "solid_volume" }]

[optimize.casting]
smallest_wall = "1 mm"
draft = "0.5 deg"

[uncertainty]
"""

DESIGNS = """\
actuator.length (mm),materials.body.C10 (MPa),mesh.cells
25,0.1,tetrahedra
30,0.11,tetrahedra
35.5,0.12,tetrahedra
"""
