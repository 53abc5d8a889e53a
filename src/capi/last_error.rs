//! The message of the last failed call, one for each thread.

use super::status::pdn_status;
use crate::error::Error;
use libc::c_char;
use std::cell::RefCell;

thread_local! {
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Message of the last call that failed on this thread: which argument, what was expected, what
/// came.
///
/// Copies as much as fits, always ended by NUL; calls that succeed leave the message as it is.
///
/// @param buffer  array of length [capacity] for the text, UTF-8; may be NULL if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the whole message without the NUL, as snprintf does; 0 if no call has failed
///
/// Threads: any; each thread has its own message.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_last_error(buffer: *mut c_char, capacity: usize) -> usize {
    MESSAGE
        .try_with(|message| {
            let message = message.borrow();
            // SAFETY: the caller gives NULL or `capacity` writable bytes.
            unsafe { copy_text(&message, buffer, capacity) };
            message.len()
        })
        // The thread is ending and its message is gone.
        .unwrap_or(0)
}

/// Keeps the message of `error` for [`pdn_last_error`] and gives its status.
pub(super) fn fail(error: &Error) -> pdn_status {
    keep(&error.to_string());
    error.kind().code()
}

/// Keeps a message.
pub(super) fn keep(text: &str) {
    // `try_with`: a thread that is ending has no message any more.
    let _ = MESSAGE.try_with(|message| text.clone_into(&mut message.borrow_mut()));
}

/// Writes what fits of `text` and a NUL into a caller's buffer of `capacity` bytes, or NULL.
pub(super) fn copy_message(text: &str, buffer: *mut c_char, capacity: usize) {
    // SAFETY: the caller gives NULL or `capacity` writable bytes.
    unsafe { copy_text(text, buffer, capacity) }
}

/// Writes what fits of `text` and a NUL, never splitting a character.
///
/// # Safety
///
/// `buffer` is NULL or has `capacity` writable bytes.
unsafe fn copy_text(text: &str, buffer: *mut c_char, capacity: usize) {
    if buffer.is_null() || capacity == 0 {
        return;
    }
    let mut length = text.len().min(capacity - 1);
    while !text.is_char_boundary(length) {
        length -= 1;
    }
    // SAFETY: length + 1 <= capacity, and a Rust string cannot overlap the caller's buffer.
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr(), buffer.cast(), length);
        buffer.add(length).write(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(capacity: usize) -> (usize, Vec<u8>) {
        let mut buffer = vec![0x7f_u8; 64];
        // SAFETY: capacity is at most the buffer's length.
        let needed = unsafe { pdn_last_error(buffer.as_mut_ptr().cast(), capacity) };
        (needed, buffer)
    }

    #[test]
    fn follows_the_rule_of_snprintf() {
        fail(&Error::value("angle", "≤ 1", 2));
        let whole = "angle: expected ≤ 1, got 2";
        let (needed, buffer) = read(64);
        assert_eq!(needed, whole.len());
        assert_eq!(&buffer[..=needed], [whole.as_bytes(), b"\0"].concat());

        // Memory for the first byte of "≤" only: the character is left out.
        let (needed, buffer) = read(18);
        assert_eq!(needed, whole.len());
        assert_eq!(&buffer[..17], b"angle: expected \0");
        assert_eq!(buffer[18], 0x7f);

        assert_eq!(read(0).1[0], 0x7f);
        // SAFETY: NULL is allowed when nothing is to be written.
        assert_eq!(unsafe { pdn_last_error(std::ptr::null_mut(), 0) }, needed);
    }

    #[test]
    fn belongs_to_one_thread() {
        fail(&Error::size("n", 3, 4));
        std::thread::spawn(|| assert_eq!(read(64).0, 0))
            .join()
            .unwrap();
        assert!(read(64).0 > 0);
    }
}
