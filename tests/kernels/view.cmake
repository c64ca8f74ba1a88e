touchstone_test(view_kernel_tests
    SOURCES view_lighting_test.cpp
    LIBRARIES touchstone_pipeline)
