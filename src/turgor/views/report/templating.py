"""Pages from templates: text in, text out, with everything escaped that is not markup of the template."""

from collections.abc import Mapping

from jinja2 import Environment, StrictUndefined


def rendered(template: str, values: Mapping[str, object]) -> str:
    """Fill a template.

    Parameters
    ----------
    template : str
        HTML with the marks of Jinja.
    values : mapping of str to object
        What the template names. A name that is missing is an error.

    Returns
    -------
    str

    Examples
    --------
    >>> rendered("<p>{{ text }}</p>", {"text": "a < b"})
    '<p>a &lt; b</p>'
    """
    page = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True).from_string(template)
    return page.render(**values)
