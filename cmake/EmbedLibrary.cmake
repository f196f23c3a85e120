# Writes the .cpp that carries the library studies inside the program: cmake -DLIBRARY=<scenarios/library> -DOUTPUT=<file.cpp> -P EmbedLibrary.cmake
# Each folder of LIBRARY with a study.yaml is a template; all files below it belong to it.
file(GLOB folders RELATIVE ${LIBRARY} ${LIBRARY}/*)
list(SORT folders)
set(arrays "")
set(tables "")
set(list "")
set(number 0)
foreach(folder ${folders})
  if(NOT EXISTS ${LIBRARY}/${folder}/study.yaml)
    continue()
  endif()
  file(GLOB_RECURSE files RELATIVE ${LIBRARY}/${folder} ${LIBRARY}/${folder}/*)
  list(SORT files)
  set(rows "")
  foreach(file ${files})
    file(READ ${LIBRARY}/${folder}/${file} bytes HEX)
    string(LENGTH "${bytes}" digits)
    math(EXPR size "${digits} / 2")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n" bytes "${bytes}")
    string(APPEND arrays "const unsigned char file_${number}[] = {${bytes}0};\n")
    string(APPEND rows "    {\"${file}\", text(file_${number}, ${size})},\n")
    math(EXPR number "${number} + 1")
  endforeach()
  string(MAKE_C_IDENTIFIER "${folder}" identifier)
  string(APPEND tables "const TemplateFile files_of_${identifier}[] = {\n${rows}};\n")
  string(APPEND list "    {\"${folder}\", files_of_${identifier}},\n")
endforeach()
file(WRITE ${OUTPUT}.new
"// Written by cmake/EmbedLibrary.cmake from the folders of scenarios/library.
#include \"scenarios/library/library.h\"

namespace morula::scenarios {
namespace {
std::string_view text(const unsigned char* bytes, std::size_t size) { return {reinterpret_cast<const char*>(bytes), size}; }
${arrays}${tables}const Template all_templates[] = {\n${list}};
}  // namespace
std::span<const Template> templates() { return all_templates; }
}  // namespace morula::scenarios
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
