"""The pages of this directory as a site: script/docs builds it with Sphinx."""

project = "Periodyn"
html_title = "Periodyn"
author = "the Periodyn developers"
extensions = ["myst_parser", "sphinx_design", "sphinx.ext.mathjax"]
myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath"]
# Headings are linked to as in the files themselves.
myst_heading_anchors = 4
exclude_patterns = ["tutorial/CMakeLists.txt", "CMakeLists.txt"]
html_theme = "furo"
html_show_sourcelink = False
html_copy_source = False
nitpicky = True
# Blocks of `report` are what the library prints, and no language.
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]
