touchstone_test(pipeline_view_test
    SOURCES mesh_shadow_test.cpp scene_view_test.cpp view_rendering_test.cpp
    LIBRARIES touchstone_pipeline)
