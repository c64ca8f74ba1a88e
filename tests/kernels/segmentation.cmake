touchstone_test(segmentation_kernel_tests
    SOURCES listing_1_test.cpp connected_components_test.cpp foreground_segmentation_test.cpp moving_parts_test.cpp
    LIBRARIES touchstone_pipeline)
