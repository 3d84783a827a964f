# SPDX-License-Identifier: MIT
# One function per kind of target. Sources are found by folder, so a new file needs no edit here.

add_library(luxel_options INTERFACE)
target_compile_options(luxel_options INTERFACE -Wall -Wextra -Wshadow -Wno-missing-field-initializers
    $<$<BOOL:${LUXEL_WERROR}>:-Werror>)
# -ffp-contract=off: the reference's images do not depend on which compiler fused which product.
target_compile_options(luxel_options INTERFACE -ffp-contract=off)
target_compile_definitions(luxel_options INTERFACE GLM_ENABLE_EXPERIMENTAL)
if(LUXEL_SANITIZE)
  target_compile_options(luxel_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
      -fno-omit-frame-pointer -O1)
  target_link_options(luxel_options INTERFACE -fsanitize=address,undefined)
endif()

function(luxel_sanitize executable)
  if(LUXEL_SANITIZE)
    target_sources(${executable} PRIVATE ${CMAKE_SOURCE_DIR}/cmake/sanitizer.cpp)
  endif()
endfunction()

# A test or benchmark executable of one folder.
function(luxel_test_executable target)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${target} ${arg_SOURCES})
  luxel_sanitize(${target})
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE LUXEL_DATA_DIR="${LUXEL_DATA_DIR}"
      LUXEL_BINARY_DIR="${CMAKE_BINARY_DIR}" LUXEL_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE ${arg_LINK})
  add_dependencies(${target} luxel-decode) # images are decoded in that process
endfunction()

# luxel_library(name [INTERFACE] [DEPENDS luxel libraries] [LINK others]): src/name/**.cpp, with
# **_test.cpp as the executable test_name and **_benchmark.cpp as benchmark_name.
function(luxel_library name)
  cmake_parse_arguments(arg "INTERFACE" "" "DEPENDS;LINK" ${ARGN})
  list(TRANSFORM arg_DEPENDS PREPEND luxel_)
  set(folder ${CMAKE_SOURCE_DIR}/src/${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(tests ${sources})
  set(benchmarks ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER benchmarks INCLUDE REGEX "_benchmark\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_(test|benchmark)\\.cpp$")
  if(arg_INTERFACE OR NOT sources)
    add_library(luxel_${name} INTERFACE)
    target_include_directories(luxel_${name} INTERFACE ${CMAKE_SOURCE_DIR}/src)
    target_link_libraries(luxel_${name} INTERFACE luxel_options glm::glm ${arg_DEPENDS} ${arg_LINK})
  else()
    add_library(luxel_${name} STATIC ${sources})
    target_include_directories(luxel_${name} PUBLIC ${CMAKE_SOURCE_DIR}/src)
    target_link_libraries(luxel_${name} PUBLIC luxel_options glm::glm ${arg_DEPENDS} ${arg_LINK})
  endif()
  if(tests)
    luxel_test_executable(test_${name} SOURCES ${tests} LINK luxel_${name} GTest::gtest GTest::gtest_main)
    include(GoogleTest)
    gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 900)
  endif()
  if(benchmarks)
    luxel_test_executable(benchmark_${name} SOURCES ${benchmarks}
        LINK luxel_${name} benchmark::benchmark benchmark::benchmark_main)
  endif()
endfunction()

function(luxel_application name)
  cmake_parse_arguments(arg "" "" "DEPENDS;LINK" ${ARGN})
  list(TRANSFORM arg_DEPENDS PREPEND luxel_)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/apps/${name}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  luxel_sanitize(${name})
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS} ${arg_LINK})
  if(NOT name STREQUAL luxel-decode)
    add_dependencies(${name} luxel-decode)
  endif()
endfunction()

# luxel_shaders(folder ...): compiles src/folder/**.{comp,vert,frag} to SPIR-V and embeds all of them in luxel_gpu,
# where gpu::shader_code() finds each by its path below src/techniques ("isr/gather.comp") or src
# ("gpu/test/fill.comp"). -O0 because -O strips the names that bindings go by; drivers optimize for themselves (measured
# on lavapipe: a loop over 256 lights is 10 % slower with spirv-opt -O before it).
function(luxel_shaders)
  find_program(GLSLC glslc REQUIRED)
  set(table "")
  set(blobs "")
  set(outputs "")
  set(index 0)
  foreach(folder ${ARGN})
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${folder}/*.comp
        ${CMAKE_SOURCE_DIR}/src/${folder}/*.vert ${CMAKE_SOURCE_DIR}/src/${folder}/*.frag)
    foreach(shader ${shaders})
      file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR}/src ${shader})
      string(REGEX REPLACE "^techniques/" "" name ${name})
      set(output ${CMAKE_BINARY_DIR}/shaders/${name}.spv)
      get_filename_component(output_folder ${output} DIRECTORY)
      file(MAKE_DIRECTORY ${output_folder})
      add_custom_command(OUTPUT ${output}
          COMMAND ${GLSLC} --target-env=vulkan1.3 -O0 -Werror -I ${CMAKE_SOURCE_DIR}/src -MD -MF ${output}.d
              -o ${output} ${shader}
          DEPENDS ${shader} DEPFILE ${output}.d COMMENT "GLSL ${name}" VERBATIM)
      list(APPEND outputs ${output})
      string(APPEND blobs "asm(\".section .rodata\\n.balign 4\\nluxel_spv_${index}:\\n.incbin \\\"${output}\\\"\\n\"\n    \"luxel_spv_${index}_end:\\n.previous\\n\");\n")
      string(APPEND blobs "extern \"C\" const std::uint32_t luxel_spv_${index}[], luxel_spv_${index}_end[];\n")
      string(APPEND table "    {\"${name}\", {luxel_spv_${index}, luxel_spv_${index}_end}},\n")
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  set(generated ${CMAKE_BINARY_DIR}/shaders/embedded_shaders.cpp)
  file(CONFIGURE OUTPUT ${generated} @ONLY CONTENT [[
// Generated by cmake/luxel.cmake.
#include "gpu/shader_code.h"

@blobs@
namespace luxel::gpu {
namespace {
constexpr std::size_t count = @index@;
}
std::span<const EmbeddedShader> embedded_shaders() {
    static const EmbeddedShader table[count + 1] = {
@table@        {"", {}}};
    return {table, count};
}
} // namespace luxel::gpu
]])
  set_source_files_properties(${generated} PROPERTIES OBJECT_DEPENDS "${outputs}")
  get_target_property(kind luxel_gpu TYPE)
  if(NOT kind STREQUAL "INTERFACE_LIBRARY")
    target_sources(luxel_gpu PRIVATE ${generated})
  endif()
endfunction()
