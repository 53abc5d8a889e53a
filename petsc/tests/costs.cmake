# What ranks send each other is what the model of costs says.
execute_process(COMMAND ${launch} ${ranks} ${program} send 16 31
    COMMAND ${check} RESULTS_VARIABLE ended OUTPUT_VARIABLE said ERROR_VARIABLE said)
message("${said}")
if(NOT ended STREQUAL "0;0")
    message(FATAL_ERROR "the model of costs does not hold: ${ended}")
endif()
