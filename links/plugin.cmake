# bl_plugin(name files...): builds link kinds and typifications as one shared library that the program loads.
# The files are the same as those in links/ and nodes/: each closes with BL_LINK or BL_TYPIFICATION under its own stem.
# Needs no built checkout: declarations are headers, everything else comes from the program that loads the library.
get_filename_component(BL_CHECKOUT ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
include(${CMAKE_CURRENT_LIST_DIR}/abi.cmake)

function(bl_plugin name)
  set(declarations "")
  set(calls "")
  set(stems "")
  set(sources "")
  foreach(source ${ARGN})
    get_filename_component(source ${source} ABSOLUTE)
    get_filename_component(stem ${source} NAME_WE)
    file(STRINGS ${source} link REGEX "^BL_LINK\\(${stem},")
    file(STRINGS ${source} typification REGEX "^BL_TYPIFICATION\\(${stem},")
    if(link)
      set(noun link)
    elseif(typification)
      set(noun typification)
    else()
      message(FATAL_ERROR "${source} must close with BL_LINK(${stem}, Type) or BL_TYPIFICATION(${stem}, Type): the word is that of the file")
    endif()
    string(APPEND declarations "void register_${noun}_${stem}(Registry& registry);\n")
    string(APPEND calls "  bl::register_${noun}_${stem}(registry);\n")
    string(APPEND stems "${stem} ")
    list(APPEND sources ${source})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  endforeach()
  bl_plugin_abi(abi SOURCE ${BL_CHECKOUT} SANITIZE "${BL_SANITIZE}")
  if(BL_PLUGIN_ABI_INSTEAD)
    set(abi "${BL_PLUGIN_ABI_INSTEAD}")  # for the test that another one is refused
  endif()
  set(entry ${CMAKE_CURRENT_BINARY_DIR}/${name}_entry.cpp)
  file(CONFIGURE OUTPUT ${entry} @ONLY CONTENT "// Written by the build: what the program asks a plugin for.
#include \"core/define/registry.h\"
namespace bl {
${declarations}}  // namespace bl
extern \"C\" {
__attribute__((visibility(\"default\"), used)) extern const char behaviourlinks_abi[] = \"BEHAVIOURLINKS-PLUGIN-ABI:${abi}\";
__attribute__((visibility(\"default\"), used)) extern const char behaviourlinks_files[] = \"${stems}\";
__attribute__((visibility(\"default\"))) void behaviourlinks_register(bl::Registry& registry) {
${calls}}
}
")
  add_library(${name} MODULE ${sources} ${entry})
  set_target_properties(${name} PROPERTIES PREFIX "" POSITION_INDEPENDENT_CODE ON CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_include_directories(${name} PRIVATE ${BL_CHECKOUT})
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -ffp-contract=off)
  if(BL_SANITIZE)
    target_compile_options(${name} PRIVATE -fsanitize=${BL_SANITIZE})
  endif()
endfunction()
