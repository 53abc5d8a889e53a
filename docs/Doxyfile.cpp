# The reference of periodyn.hpp, beside that of C, in which parameters, units and errors are told.
# Run as docs/Doxyfile, whose settings hold but for these.
@INCLUDE               = docs/Doxyfile
PROJECT_NAME           = "Periodyn for C++"
HTML_OUTPUT            = html_cpp
FILE_PATTERNS          = *.h *.hpp
OPTIMIZE_OUTPUT_FOR_C  = NO
PREDEFINED             = PDN_API= __cplusplus=201703L
EXCLUDE_SYMBOLS        = periodyn::detail periodyn::detail::*

# Every class, function and constant has a text; its parameters have those of C.
WARN_NO_PARAMDOC       = NO
WARN_IF_INCOMPLETE_DOC = NO
