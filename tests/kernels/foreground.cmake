touchstone_test(foreground_kernel_tests
    SOURCES foreground_model_test.cpp listing_2_moving_test.cpp
    LIBRARIES touchstone_pipeline)
