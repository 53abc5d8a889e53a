/* The header needs no other before it, and may be included twice. */
#include <periodyn.h>
#include <periodyn.h>

int header_compiles(void);

int header_compiles(void)
{
    return pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR) == PDN_OK;
}
