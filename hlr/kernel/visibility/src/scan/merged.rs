//! Two answers about one edge become one: at each place that which hides more, or less.

use super::invisibility::{Segment, State};

impl State {
    fn depth(self) -> u8 {
        match self {
            State::Visible => 0,
            State::Within => 1,
            State::Diving => 2,
            State::Hidden => 3,
        }
    }

    pub fn more_hidden(self, other: State) -> State {
        if self.depth() < other.depth() { other } else { self }
    }

    pub fn less_hidden(self, other: State) -> State {
        if self.depth() < other.depth() { self } else { other }
    }
}

/// Merges two results: at each place `pick` chooses the state.
pub fn merged(one: &[Segment], two: &[Segment], pick: fn(State, State) -> State) -> Vec<Segment> {
    let mut out: Vec<Segment> = Vec::with_capacity(one.len().max(two.len()));
    let (mut i, mut j, mut start) = (0, 0, 0.0);
    while let (Some(a), Some(b)) = (one.get(i), two.get(j)) {
        let end = a.end.min(b.end);
        let state = pick(a.state, b.state);
        match out.last_mut() {
            Some(last) if last.state == state => last.end = end,
            _ if end > start => out.push(Segment { start, end, state }),
            _ => {}
        }
        start = end;
        i += usize::from(a.end == end);
        j += usize::from(b.end == end);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segments(all: &[(f64, State)]) -> Vec<Segment> {
        let starts = std::iter::once(0.0).chain(all.iter().map(|s| s.0));
        all.iter().zip(starts).map(|(&(end, state), start)| Segment { start, end, state }).collect()
    }

    #[test]
    fn of_two_answers_the_one_that_hides_more_or_less() {
        use State::{Hidden, Visible, Within};
        let one = segments(&[(0.3, Visible), (0.5, Hidden), (0.6, Visible), (1.0, Hidden)]);
        let two = segments(&[(0.4, Within), (0.8, Hidden), (1.0, Visible)]);
        let picked = |pick| -> Vec<_> { merged(&one, &two, pick).iter().map(|s| (s.start, s.end, s.state)).collect() };
        assert_eq!(picked(State::more_hidden), [(0.0, 0.3, Within), (0.3, 1.0, Hidden)]);
        let less = [(0.0, 0.3, Visible), (0.3, 0.4, Within), (0.4, 0.5, Hidden), (0.5, 0.6, Visible)];
        assert_eq!(picked(State::less_hidden), [&less[..], &[(0.6, 0.8, Hidden), (0.8, 1.0, Visible)]].concat());
    }
}
