"""Engine: residuals and tangents of cells, faces, fibers and contact in compiled kernels, and linear solvers."""

from turgor.core.engine.warmup.numba_cache import prepare_kernel_cache

prepare_kernel_cache()  # before the first kernel is defined, because numba fails where it can write nowhere
