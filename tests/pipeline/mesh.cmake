touchstone_test(pipeline_mesh_test
    SOURCES surface_mesh_test.cpp
    LIBRARIES touchstone_pipeline)
