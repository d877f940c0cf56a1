"""The unit of CAD shapes."""

#: Shapes are built in millimeters: the tolerances of the CAD kernel (1e-7 of its unit) suit parts of 1 to 1000 units.
METERS_PER_CAD_UNIT = 1e-3
