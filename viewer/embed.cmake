# Files as data of the program.
#   patchlab_embed(target NAMESPACE shaders HEADER viewer/render/embedded.h FILES a.vert b.frag ...)
# adds to `target` a generated source that defines, for each file `a.vert`, the Embedded `a_vert` (viewer/platform/embedded.h) that HEADER declares.
#
# Run as a script (cmake -P) it writes that source: -DOUT=... -DNAMESPACE=... -DHEADER=... -DFILES=a|b
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(PATCHLAB_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
  function(patchlab_embed target)
    cmake_parse_arguments(EMBED "" "NAMESPACE;HEADER" "FILES" ${ARGN})
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${EMBED_NAMESPACE}_embedded.cc)
    string(JOIN "|" files ${EMBED_FILES})
    add_custom_command(
      OUTPUT ${out}
      COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAMESPACE=${EMBED_NAMESPACE} -DHEADER=${EMBED_HEADER} "-DFILES=${files}"
              -P ${PATCHLAB_EMBED_SCRIPT}
      DEPENDS ${EMBED_FILES} ${PATCHLAB_EMBED_SCRIPT}
      VERBATIM)
    target_sources(${target} PRIVATE ${out})
  endfunction()
  return()
endif()

set(source "#include \"${HEADER}\"\n\nnamespace patchlab::viewer::${NAMESPACE} {\n")
string(REPLACE "|" ";" files "${FILES}")
foreach(file ${files})
  get_filename_component(file_name ${file} NAME)
  string(MAKE_C_IDENTIFIER ${file_name} name)
  file(READ ${file} hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(APPEND source "\nstatic constexpr unsigned char ${name}_bytes[] = {${bytes}};\n"
                       "const Embedded ${name}{\"${file_name}\", ${name}_bytes, ${size}};\n")
endforeach()
file(WRITE ${OUT} "${source}\n}\n")
