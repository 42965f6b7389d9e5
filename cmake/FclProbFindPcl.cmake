# The parts of PCL that fcl_prob::cloud uses: FCL_PROB_PCL_INCLUDE_DIR and FCL_PROB_PCL_LIBRARIES. PCL's
# own package file also asks for what its visualisation needs (VTK, Qt), which is not used here.
find_path(FCL_PROB_PCL_INCLUDE_DIR pcl/pcl_config.h
  PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 pcl-1.12 REQUIRED)
mark_as_advanced(FCL_PROB_PCL_INCLUDE_DIR)
set(FCL_PROB_PCL_LIBRARIES)
foreach(part IN ITEMS common kdtree search sample_consensus segmentation filters features surface)
  find_library(FCL_PROB_PCL_${part} pcl_${part} REQUIRED)
  mark_as_advanced(FCL_PROB_PCL_${part})
  list(APPEND FCL_PROB_PCL_LIBRARIES ${FCL_PROB_PCL_${part}})
endforeach()
