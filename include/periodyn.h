/**
 * @file periodyn.h
 * Periodyn: periodic response of flexible multibody systems by Fourier spectral collocation.
 *
 * @par Errors
 * Functions that can fail return a ::pdn_status: PDN_OK, or a negative code. Then ::pdn_last_error
 * tells which argument was wrong, what was expected and what came; outputs are left untouched.
 * Whether a solve converged is no error but a part of its result.
 *
 * @par Threads
 * 1. Distinct handles may be used from distinct threads at once.
 * 2. On one handle, functions that take it as `const` may run at once; any other needs it alone.
 *    Handles may move between threads.
 * 3. The last error belongs to the thread.
 *
 * @par Memory
 * What a `_new` or an output of handle type gave is the caller's, to be freed by the `_free` of its
 * type, in any order; NULL may be freed. Arrays and texts are copied in and out.
 */

/* Written by cbindgen from src/capi. To change it: PDN_BLESS=1 cargo test --test header */


#ifndef PERIODYN_H
#define PERIODYN_H

#include <stddef.h>
#include <stdint.h>

/** Marks the functions of the library: on Windows they come from a DLL, unless PDN_STATIC is set. */
#if defined(_WIN32) && !defined(PDN_STATIC)
#define PDN_API __declspec(dllimport)
#else
#define PDN_API
#endif

/** Sets the defaults of an option struct: `PDN_INIT(pdn_example_options, &options)`. */
#define PDN_INIT(type, pointer) type##_init((pointer), sizeof *(pointer))


/**
 * Version of this header, first number.
 */
#define PDN_VERSION_MAJOR 0

/**
 * Version of this header, second number.
 */
#define PDN_VERSION_MINOR 1

/**
 * Version of this header, third number.
 */
#define PDN_VERSION_PATCH 0

/**
 * The call did what it says.
 */
#define PDN_OK 0

/**
 * A pointer that must not be NULL is NULL.
 */
#define PDN_ERR_NULL -1

/**
 * A number is NaN or infinite.
 */
#define PDN_ERR_NOT_FINITE -2

/**
 * A length or count is not allowed.
 */
#define PDN_ERR_SIZE -3

/**
 * An id names nothing in this model.
 */
#define PDN_ERR_ID -4

/**
 * A value is not allowed.
 */
#define PDN_ERR_VALUE -5

/**
 * A struct was not initialised, or was made for another library.
 */
#define PDN_ERR_STRUCT_SIZE -6

/**
 * The quantity does not exist for this object.
 */
#define PDN_ERR_NOT_AVAILABLE -7

/**
 * The model cannot be solved as it stands.
 */
#define PDN_ERR_MODEL -100

/**
 * A prescribed motion or load does not repeat after one period.
 */
#define PDN_ERR_NOT_PERIODIC -101

/**
 * The grid is too coarse to interpolate this motion.
 */
#define PDN_ERR_GRID_TOO_COARSE -200

/**
 * A callback failed or returned a number that is not finite.
 */
#define PDN_ERR_CALLBACK -201

/**
 * Out of memory.
 */
#define PDN_ERR_MEMORY -900

/**
 * Internal error, a defect of the library.
 */
#define PDN_ERR_PANIC -901

/**
 * An internal error left this handle in an unknown state.
 */
#define PDN_ERR_POISONED -902

/**
 * What a call returns: PDN_OK, or the negative code of a failure.
 *
 * Whether a solve converged is not a status but a part of its result.
 */
typedef int32_t pdn_status;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the library, such as "0.1.0".
 *
 * @return static string, never NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_version(void);

/**
 * Whether the library serves a program compiled with the header of version major.minor.
 *
 * Before 1.0 both numbers must be equal; from 1.0 on, a later minor version serves as well. Call it as
 * `pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)`.
 *
 * @param major  PDN_VERSION_MAJOR of the header
 * @param minor  PDN_VERSION_MINOR of the header
 * @return PDN_OK, PDN_ERR_VALUE
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_version_check(int32_t major,
                             int32_t minor);

/**
 * How the library was built: version, profile and platform, for reports of defects.
 *
 * @return static string, never NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_build_info(void);

/**
 * Name of a status, such as "PDN_ERR_NULL".
 *
 * @param status  any number
 * @return static string, never NULL; "PDN_ERR_UNKNOWN" for a number that is no status
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_status_name(pdn_status status);

/**
 * One-line meaning of a status. What went wrong in a given call is told by ::pdn_last_error.
 *
 * @param status  any number
 * @return static string, never NULL; "unknown status" for a number that is no status
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_status_message(pdn_status status);

/**
 * Message of the last call that failed on this thread: which argument, what was expected, what came.
 *
 * Copies as much as fits, always ended by NUL; calls that succeed leave the message as it is.
 *
 * @param buffer  array of length [capacity] for the text, UTF-8; may be NULL if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole message without the NUL, as snprintf does; 0 if no call has failed
 *
 * Threads: any; each thread has its own message.
 * @since 0.1
 */
PDN_API
size_t pdn_last_error(char *buffer,
                      size_t capacity);

/**
 * To be called by a callback that is about to report failure: says why.
 *
 * The text becomes a part of the message of the call that fails with PDN_ERR_CALLBACK.
 *
 * @param message  text in UTF-8, ended by NUL, copied; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE
 *
 * Threads: any; holds for the callback running on the calling thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_set_callback_error(const char *message);

/**
 * What the last failing callback on this thread returned.
 *
 * @return the callback's own nonzero number; 0 if none has failed
 *
 * Threads: any; each thread has its own number.
 * @since 0.1
 */
PDN_API
int32_t pdn_last_callback_code(void);

/**
 * Chooses whether internal errors are also printed to stderr. They are, unless this is called.
 *
 * An internal error (PDN_ERR_PANIC) is a defect of the library; the printed text says where it is.
 * Holds for the whole process.
 *
 * @param enabled  0 to print nothing, anything else to print
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_set_panic_printing(int32_t enabled);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* PERIODYN_H */
