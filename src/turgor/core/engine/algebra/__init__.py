"""Algebra: sparsity pattern, boundary conditions, tangent and factorization."""
