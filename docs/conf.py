"""Sphinx settings: `make docs` builds the pages, and a warning fails the build."""

from importlib.metadata import version as installed_version

project = "turgor"
author = "The turgor developers"
release = version = installed_version("turgor")
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax", "sphinx.ext.viewcode"]
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = "turgor"

myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings state types with shapes and units
napoleon_google_docstring = False
napoleon_custom_sections = [("Keys", "params_style")]  # of the tables of job files and study files
napoleon_use_rtype = False  # a type such as `range` in front of its text, not as a link to any attribute of that name
default_role = "code"
