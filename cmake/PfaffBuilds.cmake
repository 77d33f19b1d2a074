# Writes an ELF note with the build IDs of libraries, as assembler text: which builds another library is linked with
# (core/registry/later_library.hpp).
#   cmake -D NOTE=FILE -D FIRST=LIBRARY [-D SECOND=LIBRARY] -P PfaffBuilds.cmake
set(text "linked with")
foreach(library IN ITEMS ${FIRST} ${SECOND})
  # Where the linker puts it: the note's sizes and type, its owner, and the ID. Without one the file is named by its
  # contents, as in core/process/loaded_objects.hpp.
  file(READ ${library} head LIMIT 8192 HEX)
  if(head MATCHES "^(.*)(04000000(..)00000003000000|00000004000000(..)00000003)474e5500(.*)$")
    math(EXPR digits "2 * 0x${CMAKE_MATCH_3}${CMAKE_MATCH_4}")
    string(SUBSTRING "${CMAKE_MATCH_5}" 0 ${digits} build)
  else()
    file(SHA1 ${library} build)
    string(PREPEND build sha1-)
  endif()
  string(APPEND text " ${build}")
endforeach()
string(LENGTH "${text}" length)
math(EXPR length "${length} + 1")
file(WRITE ${NOTE} "\t.section .note.pfaff,\"a\",%note
\t.balign 4
\t.long 6, ${length}, 1
\t.asciz \"Pfaff\"
\t.balign 4
\t.asciz \"${text}\"
\t.balign 4
\t.section .note.GNU-stack,\"\",%progbits
")
