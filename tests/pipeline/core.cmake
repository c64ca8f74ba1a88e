touchstone_test(pipeline_core_test
    SOURCES background_model_test.cpp resting_tiles_test.cpp interaction_pipeline_test.cpp interactive_area_test.cpp rendering_test.cpp self_test_test.cpp
    LIBRARIES touchstone_pipeline touchstone_simulator)
touchstone_test(pipeline_relocalisation_test
    SOURCES relocalisation_test.cpp
    LIBRARIES touchstone_pipeline)
