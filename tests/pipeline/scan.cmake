touchstone_test(pipeline_scan_test
    SOURCES keyframes_test.cpp scan_file_test.cpp
    LIBRARIES touchstone_pipeline touchstone_image)
