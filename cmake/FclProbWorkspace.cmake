# What makes an installed tree a part of a ROS workspace: its manifest, its mark in the ament index, and the
# hooks that colcon.pkg names, by which the workspace's set-up finds the Python package.
install(FILES package.xml DESTINATION share/fcl_prob COMPONENT development)

file(WRITE ${PROJECT_BINARY_DIR}/workspace/fcl_prob "")
install(FILES ${PROJECT_BINARY_DIR}/workspace/fcl_prob
  DESTINATION share/ament_index/resource_index/packages COMPONENT development)

set(pythonpath_dsv "")
set(pythonpath_sh "")
if(FCL_PROB_BUILD_PYTHON)
  set(pythonpath_dsv "prepend-non-duplicate;PYTHONPATH;${FCL_PROB_PYTHON_DIR}\n")
  set(pythonpath_sh
    "_colcon_prepend_unique_value PYTHONPATH \"$COLCON_CURRENT_PREFIX/${FCL_PROB_PYTHON_DIR}\"\n")
endif()
# Not called "pythonpath", as colcon's own hook may be.
foreach(kind dsv sh)
  file(WRITE ${PROJECT_BINARY_DIR}/workspace/python_package.${kind} "${pythonpath_${kind}}")
  install(FILES ${PROJECT_BINARY_DIR}/workspace/python_package.${kind} DESTINATION share/fcl_prob/hook
    COMPONENT development)
endforeach()
