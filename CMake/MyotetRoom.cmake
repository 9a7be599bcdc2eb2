# SPDX-License-Identifier: Apache-2.0
# One room of the house is one static library; its name is its folder's name.

add_library(myotet_flags INTERFACE)
target_compile_options(myotet_flags INTERFACE -Wall -Wextra -Wshadow -Wno-unknown-pragmas
  -Wno-missing-field-initializers  # designated initialisers name what differs from the defaults
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # false alarms of GCC 12 on string sums
if(MYOTET_NATIVE)
  target_compile_options(myotet_flags INTERFACE -march=native)
endif()
if(MYOTET_SANITIZE)
  target_compile_options(myotet_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(myotet_flags INTERFACE -fsanitize=address,undefined)
endif()

# myotet_room(Name [ROOMS Core ...] [PUBLIC lib ...] [PRIVATE lib ...])
# Compiles every .cpp of the current folder. ROOMS are the rooms it may include.
function(myotet_room name)
  cmake_parse_arguments(ROOM "" "" "ROOMS;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(myotet_${name} STATIC ${sources})
  add_library(myotet::${name} ALIAS myotet_${name})
  target_include_directories(myotet_${name} PUBLIC ${PROJECT_SOURCE_DIR}/Modules ${PROJECT_SOURCE_DIR}/Simulation)
  list(TRANSFORM ROOM_ROOMS PREPEND myotet::)
  target_link_libraries(myotet_${name}
    PUBLIC ${ROOM_ROOMS} ${ROOM_PUBLIC}
    PRIVATE myotet_flags ${ROOM_PRIVATE})
endfunction()

# myotet_test(Room [ROOMS ...] [LIBS ...])
# Compiles every .cpp of the current folder into one test program.
function(myotet_test name)
  cmake_parse_arguments(TEST "" "" "ROOMS;LIBS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/Testing)
  target_compile_definitions(test_${name} PRIVATE
    MYOTET_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  list(TRANSFORM TEST_ROOMS PREPEND myotet::)
  target_link_libraries(test_${name} PRIVATE myotet_flags ${TEST_ROOMS} ${TEST_LIBS}
    GTest::gmock GTest::gtest_main)
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}: " DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600)
endfunction()
