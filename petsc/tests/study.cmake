# A study has the same results as its cases one after the other; started again, it solves nothing.
set(file study_${ranks}.csv)
file(REMOVE ${file})
foreach(expected IN ITEMS "0 cases known, 6 solved, 0 failed" "6 cases known, 0 solved, 0 failed")
    execute_process(COMMAND ${launch} ${ranks} ${program} 6 ${file} compare
        RESULT_VARIABLE ended OUTPUT_VARIABLE said)
    if(NOT ended EQUAL 0 OR NOT said MATCHES "${expected}" OR NOT said MATCHES "the same results")
        message(FATAL_ERROR "expected ${expected}; it ended with ${ended}: ${said}")
    endif()
endforeach()
