include(${CMAKE_CURRENT_LIST_DIR}/svnetTargets.cmake)
