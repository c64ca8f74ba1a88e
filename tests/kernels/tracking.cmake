touchstone_test(tracking_kernel_tests
    SOURCES camera_tracking_test.cpp image_pyramid_test.cpp tracking_rows_test.cpp
    LIBRARIES touchstone_pipeline)
