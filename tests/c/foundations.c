/* Version, status and error message: what every program meets first. */
#include "check.h"

static void versions_fit(void)
{
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", PDN_VERSION_MAJOR, PDN_VERSION_MINOR,
             PDN_VERSION_PATCH);
    CHECK(strcmp(pdn_version(), version) == 0);
    CHECK(strstr(pdn_build_info(), version) != NULL);
    CHECK_STATUS(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR), PDN_OK);
    CHECK_STATUS(pdn_version_check(PDN_VERSION_MAJOR + 1, 0), PDN_ERR_VALUE);
    CHECK_MESSAGE("version: expected a header that fits library");
}

static void every_number_has_a_name(void)
{
    CHECK(strcmp(pdn_status_name(PDN_OK), "PDN_OK") == 0);
    CHECK(strcmp(pdn_status_name(PDN_ERR_POISONED), "PDN_ERR_POISONED") == 0);
    CHECK(strcmp(pdn_status_name(12345), "PDN_ERR_UNKNOWN") == 0);
    CHECK(strlen(pdn_status_message(PDN_ERR_NULL)) > 0);
}

static void message_is_copied_as_far_as_it_fits(void)
{
    char buffer[8];
    size_t needed;
    CHECK_STATUS(pdn_set_callback_error(NULL), PDN_ERR_NULL);
    CHECK_MESSAGE("message: expected a pointer, got NULL");
    needed = pdn_last_error(NULL, 0);
    CHECK(needed == strlen("message: expected a pointer, got NULL"));
    memset(buffer, 'x', sizeof buffer);
    CHECK(pdn_last_error(buffer, 5) == needed);
    CHECK(strcmp(buffer, "mess") == 0 && buffer[5] == 'x');
    /* Success leaves it. */
    CHECK_STATUS(pdn_set_callback_error("no matter"), PDN_OK);
    CHECK(pdn_last_error(NULL, 0) == needed);
    /* Libraries on top have their own. */
    CHECK_STATUS(pdn_set_last_error(NULL), PDN_ERR_NULL);
    CHECK_STATUS(pdn_set_last_error("another"), PDN_OK);
    CHECK(pdn_last_error(buffer, sizeof buffer) == 7 && strcmp(buffer, "another") == 0);
}

int main(void)
{
    CHECK(pdn_last_error(NULL, 0) == 0);
    CHECK(pdn_last_callback_code() == 0);
    versions_fit();
    every_number_has_a_name();
    message_is_copied_as_far_as_it_fits();
    pdn_set_panic_printing(0);
    CHECK_STATUS(pdn_release_memory(), PDN_OK);
    return 0;
}
