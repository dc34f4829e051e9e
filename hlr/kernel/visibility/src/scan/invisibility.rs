//! Quantitative invisibility along a drawn edge: the count at its start, then its changes in exact order.

use std::cmp::Ordering;

use super::query_points::Count;
use hlr_exact::parameter::Place;

/// A change of the count along drawn edge number `drawn`.
#[derive(Clone, Copy, Debug)]
pub struct Event<P> {
    pub drawn: u32,
    pub at: P,
    pub plain: i32,
    pub moved: i32,
}

/// What is known of a piece of a drawn edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum State {
    Visible = 0,
    Hidden = 1,
    /// Hidden by less than the contact tolerance: in contact with the surface in front.
    Within = 2,
    /// As `Within`, but next to a place where it is hidden by more: not a contact but a stub left by the tolerance.
    ///
    /// ```text
    ///        in front \  stub   \ hidden           a contact that ends behind something else is no stub:
    ///   ---------------\---------\---------- line   the count jumps there at a border, not at a depth
    ///                   \ delta   \
    /// ```
    Diving = 3,
}

/// One piece of one edge; parameters run from the edge's first to its second vertex.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub edge: u32,
    pub segment: Segment,
}

#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub start: f64,
    pub end: f64,
    pub state: State,
}

fn state(count: Count) -> State {
    match (count.plain, count.moved) {
        (..=0, _) => State::Visible,
        (_, ..=0) => State::Within,
        _ => State::Hidden,
    }
}

/// Counts along the edge over its events (any order; sorted here). False if a count became negative or differs from the
/// independent count at the end; `out` is then empty.
pub fn walk<P: Place>(start: Count, events: &mut [Event<P>], end: Count, out: &mut Vec<Segment>) -> bool {
    out.clear();
    events.sort_unstable_by(|a, b| a.at.compare(&b.at));
    let mut count = start;
    let mut from = P::START;
    let mut surfacing = false;
    let mut k = 0;
    while k < events.len() {
        let at = events[k].at;
        let mut next = count;
        let mut by_depth = false;
        while k < events.len() && events[k].at.compare(&at) == Ordering::Equal {
            next.plain += events[k].plain;
            next.moved += events[k].moved;
            // One of the two counts changes alone only where the edge, moved by the tolerance, passes through a
            // surface.
            by_depth |= events[k].plain == 0;
            k += 1;
        }
        if next.plain < 0 || next.moved < 0 {
            out.clear();
            return false;
        }
        let (now, then) = (state(count), state(next));
        if now != then {
            let diving = surfacing || (by_depth && then == State::Hidden);
            push(out, from, at, if now == State::Within && diving { State::Diving } else { now });
            surfacing = by_depth && now == State::Hidden;
            from = at;
        }
        count = next;
    }
    let last = state(count);
    push(out, from, P::END, if last == State::Within && surfacing { State::Diving } else { last });
    if count != end {
        out.clear();
        return false;
    }
    true
}

fn push<P: Place>(out: &mut Vec<Segment>, from: P, to: P, state: State) {
    let (start, end) = (from.value(), to.value());
    if end > start {
        out.push(Segment { start, end, state });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hlr_exact::parameter::Parameter;

    fn event(n: i64, d: i64, jump: i32) -> Event<Parameter> {
        Event { drawn: 0, at: Parameter::crossing(n, d), plain: jump, moved: jump }
    }

    #[test]
    fn a_stub_ends_at_a_depth_and_a_contact_at_a_border() {
        let behind = |moved| Count { plain: 1, moved };
        let mut out = Vec::new();
        let depth = Event { drawn: 0, at: Parameter::crossing(1, 2), plain: 0, moved: 1 };
        assert!(walk(behind(0), &mut [depth], behind(1), &mut out));
        assert_eq!((out[0].state, out[1].state), (State::Diving, State::Hidden));
        assert!(walk(behind(1), &mut [Event { moved: -1, ..depth }], behind(0), &mut out));
        assert_eq!((out[0].state, out[1].state), (State::Hidden, State::Diving));
        assert!(walk(behind(0), &mut [event(1, 2, 1)], Count { plain: 2, moved: 1 }, &mut out));
        assert_eq!((out[0].state, out[1].state), (State::Within, State::Hidden));
    }

    const NONE: Count = Count { plain: 0, moved: 0 };

    #[test]
    fn equal_parameters_are_merged() {
        let mut out = Vec::new();
        assert!(walk(NONE, &mut [event(2, 4, -1), event(1, 2, 1)], NONE, &mut out));
        assert_eq!(out.len(), 1);
    }

    #[test]
    fn a_wrong_end_is_noticed() {
        let mut out = Vec::new();
        assert!(!walk(NONE, &mut [event(1, 2, 1)], NONE, &mut out));
        assert!(out.is_empty(), "what is found another way must not be added to this");
        assert!(!walk(NONE, &mut [event(1, 3, -1), event(1, 2, 1)], NONE, &mut out));
    }
}
