//! Numbers for tests that look random and are the same on every run.

/// 31 random bits each time.
pub fn bits(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state >> 33
    }
}

/// Each time a number from 0 to below the one that is given.
pub fn below(seed: u64) -> impl FnMut(i32) -> i32 {
    let mut bits = bits(seed);
    move |n| (bits() as i32).rem_euclid(n)
}
