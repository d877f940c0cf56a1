"""Engine: residuals and tangents of cells, faces, fibers and contact in compiled loops, and linear solvers."""

from turgor.core.engine.cache_folder import keep_compiled_loops

keep_compiled_loops()  # before the first loop is defined, because numba fails where it can write nowhere
