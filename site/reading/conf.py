"""Settings of Sphinx for the site; build.py writes the pages and starts it."""

from pathlib import Path

from numpydoc.xref import DEFAULT_LINKS

import driftlab
from reading.doors import names

project = "Drift Lab"
author = project_copyright = "The Drift Lab authors"
version = release = driftlab.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "numpydoc",
    "myst_nb",
    "sphinx_copybutton",
    "reading.extension",
]
default_role = "py:obj"

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings say types, with shapes and units
autodoc_preserve_defaults = True
toc_object_entries_show_parents = "hide"
numpydoc_show_class_members = False
numpydoc_xref_param_type = True  # a type that is a class of the package is a link to it
numpydoc_xref_ignore = "all"
numpydoc_xref_aliases = {
    name.documented.rpartition(".")[2]: name.documented for name in names() if name.kind == "class"
}
DEFAULT_LINKS.clear()  # they lead to the pages of Python and NumPy, which are elsewhere
numpydoc_class_members_toctree = False

myst_enable_extensions = ["amsmath", "dollarmath"]
myst_heading_anchors = 4
nb_execution_mode = "off"
nb_merge_streams = True
nb_render_markdown_format = "myst"  # or tables and formulas of outputs stay raw
nb_ipywidgets_js: dict[str, dict[str, str]] = {}  # they would come from elsewhere

html_theme = "furo"
html_title = "Drift Lab"
html_static_path = ["_static"]
html_favicon = "_static/favicon.svg"
html_css_files = ["site.css", "chapters.css"]
html_js_files = [("../in_place/begin.js", {"defer": "defer"})]
html_search_scorer = str(Path(__file__).with_name("search_order.js"))
html_copy_source = False
html_show_sourcelink = False
mathjax_path = "mathjax/tex-chtml.js"
copybutton_prompt_text = r">>> |\.\.\. "
copybutton_prompt_is_regexp = True
