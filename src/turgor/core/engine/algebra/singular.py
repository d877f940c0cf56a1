"""The error of a tangent that has no factors."""


class SingularTangentError(RuntimeError):
    """The tangent could not be factored."""
