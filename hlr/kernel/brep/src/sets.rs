//! Sets that are united one by one, as faces that hang together.

/// The sets of the numbers below a count; the least member stands for each.
pub struct Sets(Vec<usize>);

impl Sets {
    /// Each number is a set of its own.
    pub fn new(count: usize) -> Sets {
        Sets((0..count).collect())
    }

    /// The least member of the set of a number.
    pub fn first(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    pub fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_member_stands_for_a_set() {
        let mut sets = Sets::new(6);
        for (a, b) in [(4, 2), (5, 4), (1, 3)] {
            sets.unite(a, b);
        }
        assert_eq!([0, 1, 2, 3, 4, 5].map(|i| sets.first(i)), [0, 1, 2, 1, 2, 2]);
    }
}
