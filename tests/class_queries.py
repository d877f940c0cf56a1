"""Which classes a file asks for: a new class of the kind would need a change there."""

import ast


def queried(text: str) -> set[str]:
    """Return names of classes to which a file compares values.

    Examples
    --------
    >>> sorted(queried("isinstance(a, b.Force | Moment); type(a) is Spin; type(a).__name__ == 'Weight'"))
    ['Force', 'Moment', 'Spin', 'Weight', 'b']
    >>> queried("match a:\\n    case Gravity():\\n        pass")
    {'Gravity'}
    """
    nodes = list(ast.walk(ast.parse(text)))
    calls = [each for each in nodes if isinstance(each, ast.Call) and len(each.args) == 2]
    kinds = [each.args[1] for each in calls if getattr(each.func, "id", "") in ("isinstance", "issubclass")]
    kinds += [each.cls for each in nodes if isinstance(each, ast.MatchClass)]
    compared = [[each.left, *each.comparators] for each in nodes if isinstance(each, ast.Compare)]
    kinds += [side for sides in compared if any(map(_of_type, sides)) for side in sides if not _of_type(side)]
    parts = [part for kind in kinds for part in ast.walk(kind)]
    found = {getattr(part, "id", getattr(part, "attr", getattr(part, "value", None))) for part in parts}
    return {each for each in found if isinstance(each, str)}


def _of_type(node: ast.expr) -> bool:
    """Whether an expression is the class of a value, or its name."""
    text = ast.unparse(node)
    return text.startswith("type(") or text.endswith(("__class__", "__class__.__name__"))
