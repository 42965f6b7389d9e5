# install() and find_package(fcl_prob).
include(CMakePackageConfigHelpers)
set(FCL_PROB_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/fcl_prob)

set(fcl_prob_installed fcl_prob)
set(fcl_prob_headers_left_out)
# Installs a wing, if it is built; else leaves out its headers.
macro(fcl_prob_install_wing room with)
  if(${with})
    list(APPEND fcl_prob_installed fcl_prob_${room})
  else()
    foreach(header ${ARGN})
      list(APPEND fcl_prob_headers_left_out PATTERN ${header} EXCLUDE)
    endforeach()
  endif()
endmacro()
fcl_prob_install_wing(io FCL_PROB_WITH_ASSIMP mesh_io.h scene_io.h octomap_io.h)
fcl_prob_install_wing(cloud FCL_PROB_WITH_CLOUD point_cloud.h sensor_model.h reconstruction.h)
fcl_prob_install_wing(robot FCL_PROB_WITH_ROBOT robot.h robot_groups.h robot_query.h robot_scene.h self_collision.h
                       urdf.h)
fcl_prob_install_wing(planning FCL_PROB_WITH_PLANNING motion_planning.h certified_planning.h
                       timed_planning.h ompl.h)
install(TARGETS ${fcl_prob_installed} EXPORT fcl_prob-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library)
if(FCL_PROB_BUILD_CLI)
  install(TARGETS fcl_prob_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
endif()
if(FCL_PROB_BUILD_MPI)
  install(TARGETS fcl_prob_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()
install(DIRECTORY include/fcl_prob DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  ${fcl_prob_headers_left_out})
install(EXPORT fcl_prob-targets NAMESPACE fcl_prob:: DESTINATION ${FCL_PROB_CMAKE_DIR}
  COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/include/fcl_prob/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fcl_prob COMPONENT development)
include(FclProbWorkspace)

# For builds without CMake. A static library does not know what it needs, so that its users link it, too.
file(RELATIVE_PATH fcl_prob_pc_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(fcl_prob_pc_libs)
set(fcl_prob_pc_packages)
if(NOT BUILD_SHARED_LIBS)
  set(fcl_prob_pc_libs " -ltbbmalloc")
  set(fcl_prob_pc_packages " qhullcpp qhull_r tbb")
endif()
configure_file(cmake/fcl_prob.pc.in ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob.pc.in @ONLY)
file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob.pc
  INPUT ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob.pc.in)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT development)

configure_package_config_file(cmake/fcl_prob-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config.cmake INSTALL_DESTINATION ${FCL_PROB_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config-version.cmake DESTINATION ${FCL_PROB_CMAKE_DIR}
  COMPONENT development)
