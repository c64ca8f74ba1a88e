touchstone_test(particle_kernel_tests
    SOURCES radix_sort_test.cpp
    LIBRARIES touchstone_pipeline)
