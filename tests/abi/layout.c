/* Sizes and offsets that no release of this soname may change. Structs may grow at their end only.
 */
#include <periodyn.h>

_Static_assert(sizeof(pdn_status) == 4, "pdn_status");
_Static_assert(PDN_OK == 0, "PDN_OK");
_Static_assert(PDN_ERR_NULL == -1, "PDN_ERR_NULL");
_Static_assert(PDN_ERR_NOT_FINITE == -2, "PDN_ERR_NOT_FINITE");
_Static_assert(PDN_ERR_SIZE == -3, "PDN_ERR_SIZE");
_Static_assert(PDN_ERR_ID == -4, "PDN_ERR_ID");
_Static_assert(PDN_ERR_VALUE == -5, "PDN_ERR_VALUE");
_Static_assert(PDN_ERR_STRUCT_SIZE == -6, "PDN_ERR_STRUCT_SIZE");
_Static_assert(PDN_ERR_NOT_AVAILABLE == -7, "PDN_ERR_NOT_AVAILABLE");
_Static_assert(PDN_ERR_MODEL == -100, "PDN_ERR_MODEL");
_Static_assert(PDN_ERR_NOT_PERIODIC == -101, "PDN_ERR_NOT_PERIODIC");
_Static_assert(PDN_ERR_GRID_TOO_COARSE == -200, "PDN_ERR_GRID_TOO_COARSE");
_Static_assert(PDN_ERR_CALLBACK == -201, "PDN_ERR_CALLBACK");
_Static_assert(PDN_ERR_MEMORY == -900, "PDN_ERR_MEMORY");
_Static_assert(PDN_ERR_PANIC == -901, "PDN_ERR_PANIC");
_Static_assert(PDN_ERR_POISONED == -902, "PDN_ERR_POISONED");
