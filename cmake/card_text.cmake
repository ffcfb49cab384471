# Writes the source OUT, a function with the text of the file PTX; with an empty text if PTX is empty. A file
# that has this content already is not written again.
set(text "")
if(PTX)
  file(READ "${PTX}" text)
endif()
set(source "#include \"sinew/card/walk.h\"
std::string_view sinew::card::walk_ptx() { return R\"ptx(${text})ptx\"; }
")
set(old "")
if(EXISTS "${OUT}")
  file(READ "${OUT}" old)
endif()
if(NOT old STREQUAL source)
  file(WRITE "${OUT}" "${source}")
endif()
