# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#
# The generator qp_codegen as a target, and qp_codegen_add_solver(TARGET SPEC), which runs it in the build and makes an
# object library of what it writes: one object per instruction set, and nothing that must be linked.

set(QP_CODEGEN_DIR ${CMAKE_CURRENT_LIST_DIR})

# The C templates go into the program as raw string literals, so that qp_codegen needs no file at run time.
function(qp_codegen_embed_templates OUTPUT)
  file(GLOB templates CONFIGURE_DEPENDS ${QP_CODEGEN_DIR}/templates/*)
  add_custom_command(OUTPUT ${OUTPUT}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${OUTPUT} "-DTEMPLATES=${templates}" -P ${QP_CODEGEN_DIR}/embed_templates.cmake
    DEPENDS ${templates} ${QP_CODEGEN_DIR}/embed_templates.cmake VERBATIM)
endfunction()

qp_codegen_embed_templates(${CMAKE_CURRENT_BINARY_DIR}/qp_codegen_templates.cpp)
file(GLOB QP_CODEGEN_SOURCES CONFIGURE_DEPENDS ${QP_CODEGEN_DIR}/*.cpp)
#catkin_lint: ignore_once missing_file
add_library(qp_codegen_core STATIC ${QP_CODEGEN_SOURCES} ${CMAKE_CURRENT_BINARY_DIR}/qp_codegen_templates.cpp)
target_include_directories(qp_codegen_core PUBLIC ${QP_CODEGEN_DIR}/../../../include)
target_link_libraries(qp_codegen_core PUBLIC yaml-cpp)
set_target_properties(qp_codegen_core PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON POSITION_INDEPENDENT_CODE ON)
add_executable(qp_codegen ${QP_CODEGEN_DIR}/../qp_codegen_main.cpp)
set_target_properties(qp_codegen PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
target_link_libraries(qp_codegen qp_codegen_core)

# qp_codegen_add_solver(TARGET SPEC [BASE]): library TARGET from config SPEC (its `name` must be TARGET), and from BASE if
# SPEC says so.
function(qp_codegen_add_solver TARGET SPEC)
  set(dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
  file(MAKE_DIRECTORY ${dir})
  add_custom_command(OUTPUT ${dir}/${TARGET}.c ${dir}/${TARGET}.h COMMAND qp_codegen ${SPEC} ${dir}
    DEPENDS qp_codegen ${SPEC} ${ARGN} VERBATIM)
  add_custom_target(${TARGET}_generated DEPENDS ${dir}/${TARGET}.c ${dir}/${TARGET}.h)
  string(TOUPPER ${TARGET} prefix)
  set(flags_baseline "")
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mfma)
  set(sets baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(sets baseline avx2 avx512)
  endif()
  set(objects "")
  foreach(set ${sets})
    add_library(${TARGET}_${set} OBJECT ${dir}/${TARGET}.c)
    add_dependencies(${TARGET}_${set} ${TARGET}_generated)
    set_target_properties(${TARGET}_${set} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_definitions(${TARGET}_${set} PRIVATE ${prefix}_SET=${set})
    target_compile_options(${TARGET}_${set} PRIVATE -std=c99 -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math
      -ffreestanding -fno-stack-protector ${flags_${set}})
    list(APPEND objects $<TARGET_OBJECTS:${TARGET}_${set}>)
  endforeach()
  add_library(${TARGET} STATIC ${objects})
  set_target_properties(${TARGET} PROPERTIES LINKER_LANGUAGE C)
  target_include_directories(${TARGET} PUBLIC ${dir})
  add_dependencies(${TARGET} ${TARGET}_generated)
endfunction()
