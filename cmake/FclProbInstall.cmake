# install() and find_package(fcl_prob).
include(CMakePackageConfigHelpers)
set(FCL_PROB_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/fcl_prob)

set(fcl_prob_installed fcl_prob)
set(headers_of_io PATTERN mesh_io.h EXCLUDE PATTERN scene_io.h EXCLUDE
  PATTERN octomap_io.h EXCLUDE)
if(FCL_PROB_WITH_ASSIMP)
  list(APPEND fcl_prob_installed fcl_prob_io)
  set(headers_of_io)
endif()
set(headers_of_cloud PATTERN point_cloud.h EXCLUDE PATTERN sensor_model.h EXCLUDE
  PATTERN reconstruction.h EXCLUDE)
if(FCL_PROB_WITH_CLOUD)
  list(APPEND fcl_prob_installed fcl_prob_cloud)
  set(headers_of_cloud)
endif()
set(headers_of_robot PATTERN robot.h EXCLUDE PATTERN robot_query.h EXCLUDE)
if(FCL_PROB_WITH_ROBOT)
  list(APPEND fcl_prob_installed fcl_prob_robot)
  set(headers_of_robot)
endif()
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
  ${headers_of_io} ${headers_of_robot}
  ${headers_of_cloud})
install(EXPORT fcl_prob-targets NAMESPACE fcl_prob:: DESTINATION ${FCL_PROB_CMAKE_DIR}
  COMPONENT development)
install(FILES package.xml DESTINATION share/fcl_prob COMPONENT development)

configure_package_config_file(cmake/fcl_prob-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config.cmake INSTALL_DESTINATION ${FCL_PROB_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/fcl_prob-config-version.cmake DESTINATION ${FCL_PROB_CMAKE_DIR}
  COMPONENT development)
