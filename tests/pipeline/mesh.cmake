touchstone_test(pipeline_mesh_test
    SOURCES cell_triangles_test.cpp mesh_file_test.cpp surface_mesh_test.cpp
    LIBRARIES touchstone_pipeline PkgConfig::ASSIMP)
