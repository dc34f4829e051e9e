//! Counts the memory that a thread holds, so that work can stop before memory runs out.
//!
//! A refused allocation ends the process; Rust cannot recover from it. So the system's allocator is counted here,
//! thread by thread, and long work looks at the count as it looks at the clock (`limits`).

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counted;

#[global_allocator]
static ALLOCATOR: Counted = Counted;

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
}

/// Bytes that this thread has allocated and not freed; negative where it frees what other threads allocated.
pub fn held() -> isize {
    HELD.with(Cell::get)
}

#[inline(always)]
fn count(bytes: isize) {
    // A thread that is ending has no count any more, and needs none.
    let _ = HELD.try_with(|held| held.set(held.get().wrapping_add(bytes)));
}

// SAFETY: every call is passed on to the system's allocator unchanged; counting neither allocates nor unwinds.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as isize - layout.size() as isize);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_held_is_counted() {
        let before = held();
        let block = vec![0u8; 1 << 20];
        assert_eq!(held() - before, 1 << 20);
        drop(block);
        assert_eq!(held(), before);
    }
}
