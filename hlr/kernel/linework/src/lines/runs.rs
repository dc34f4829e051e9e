//! Runs of visible and hidden pieces along one chain: joins equal states, decides doubtful and very short runs, and
//! cuts the chain into lines.
//!
//! ```text
//!   states   V V V D H H H W W W W W V     W: hidden by less than the contact tolerance; D: W that leads to H
//!   decided  V V V H H H H V V V V V V     D is a stub left by the tolerance, so hidden; W is a contact, so visible
//! ```

use smallvec::{SmallVec, smallvec};

use super::geometry::{Chain, Geometry};
use super::loops::Kept;
use super::{Polyline, distance};
use hlr_brep::geometry::vector::{length, sub};
use hlr_visibility::scan::invisibility::State;

#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// A run shorter than this takes the state of its neighbours.
    pub short: f64,
    /// A run in state D (see above) shorter than this is hidden.
    pub stub: f64,
    /// A hidden run shorter than this between visible ones is visible: only the contour's own folds hide it. A short
    /// visible run never becomes hidden so, for a true outline may be broken into many such runs.
    pub noise: f64,
    /// Loops that reach no farther than this beside the lines that stay are cut off; 0: none is.
    pub loops: f64,
    /// A line ends, and another begins, where it is seen end-on for longer than this, in model units.
    pub end_on: f64,
}

/// A stretch of constant state between two stops, each (position in the chain, parameter along the walk).
#[derive(Clone, Copy, Debug)]
struct Run {
    state: State,
    from: (usize, f64),
    to: (usize, f64),
    length: f64,
}

/// Runs one after another; most lines have one or two.
type Runs = SmallVec<[Run; 2]>;

impl Chain<'_> {
    /// Contiguous stretches, each a list of runs in alternating states.
    fn stretches(&self) -> SmallVec<[Runs; 1]> {
        let g = self.geometry;
        let mut out: SmallVec<[Runs; 1]> = SmallVec::new();
        let mut broken = true;
        for k in 0..self.edges.len() {
            let pieces = g.pieces_of(self.edges[k]);
            let (a, b) = self.ends(k);
            broken |= k > 0 && self.ends(k - 1).1 != a;
            let [low, high] = self.kept.range(k);
            if low > high {
                continue;
            }
            if pieces.is_empty() {
                // An edge seen end-on has no pieces; the chain continues. Other edges without pieces were clipped.
                broken |= g.flat(a) != g.flat(b);
                continue;
            }
            let whole = distance(&g.flat(a), &g.flat(b));
            for i in 0..pieces.len() {
                let piece = if self.reversed[k] { &pieces[pieces.len() - 1 - i] } else { &pieces[i] };
                let (s, t) =
                    if self.reversed[k] { (1.0 - piece.end, 1.0 - piece.start) } else { (piece.start, piece.end) };
                let (s, t) = (s.max(low), t.min(high));
                if s >= t {
                    continue;
                }
                let run = Run { state: piece.state, from: (k, s), to: (k, t), length: whole * (t - s) };
                match out.last_mut() {
                    Some(last) if !broken => join(last, run),
                    _ => out.push(smallvec![run]),
                }
                broken = false;
            }
        }
        out
    }

    /// Whether there is one stretch that ends where it begins, with nothing clipped away in between.
    fn closed(&self, stretches: &[Runs]) -> bool {
        let [runs] = stretches else { return false };
        let last = self.edges.len() - 1;
        last > 0 && self.ends(0).0 == self.ends(last).1 && self.at(runs[0].from).0 == self.at(runs[runs.len() - 1].to).0
    }

    /// Adds the line of these runs. It has no bits that are one point on paper; a long one divides it, for the points before
    /// and after it are far apart in space:
    ///
    /// ```text
    ///     from the front                  from the side
    ///       |                                       |
    ///       o                                o------o
    ///       |                                |
    /// ```
    fn add_lines(&self, runs: &[Run], id: u32, end_on: f64, out: &mut Vec<Polyline>) {
        let most = runs.iter().map(|run| run.to.0 - run.from.0 + 2).sum();
        let empty = |most| Polyline {
            chain: id,
            visible: runs[0].state == State::Visible,
            flat: Vec::with_capacity(most),
            space: Vec::with_capacity(most),
            ..Polyline::default()
        };
        let mut line = empty(most);
        let mut put = |stop: (usize, f64)| {
            let (flat, space) = self.at(stop);
            if line.flat.last() == Some(&flat) {
                if line.space.last().is_none_or(|last| length(&sub(&space, last)) <= end_on) {
                    return;
                }
                let before = std::mem::replace(&mut line, empty(0));
                out.extend((before.flat.len() > 1).then_some(before));
            }
            line.flat.push(flat);
            line.space.push(space);
        };
        for run in runs {
            put(run.from);
            for k in run.from.0..run.to.0 {
                let [low, high] = self.kept.range(k);
                if low < high {
                    put((k, high));
                }
            }
            put(run.to);
        }
        out.extend((line.flat.len() > 1).then_some(line));
    }
}

fn join(runs: &mut Runs, run: Run) {
    if let Some(last) = runs.last_mut()
        && last.state == run.state
    {
        last.to = run.to;
        last.length += run.length;
        return;
    }
    runs.push(run);
}

/// Whether a W run is the beginning of a stub: a D run lies next to it, and both together are shorter than a stub.
fn dives(runs: &[Run], i: usize, stub: f64, closed: bool) -> bool {
    beside(runs, i, closed)
        .into_iter()
        .flatten()
        .any(|next| next.state == State::Diving && runs[i].length + next.length < stub)
}

/// Joins neighbours that now have the same state.
fn rejoin(runs: &mut Runs) {
    runs.dedup_by(|run, last| {
        let same = run.state == last.state;
        if same {
            last.to = run.to;
            last.length += run.length;
        }
        same
    });
}

/// The runs before and after run i; a closed chain wraps around.
fn beside(runs: &[Run], i: usize, closed: bool) -> [Option<&Run>; 2] {
    let n = runs.len();
    let before = if i > 0 { Some(&runs[i - 1]) } else { (closed && n > 1).then(|| &runs[n - 1]) };
    let after = if i + 1 < n { Some(&runs[i + 1]) } else { (closed && n > 1).then(|| &runs[0]) };
    [before, after]
}

/// Marks the D run i, and a W run that leads to it, if the line goes through a surface where they begin: from there on it
/// is hidden by more and more, however long that takes. A D run that is a stub is hidden anyway, and not asked about.
fn goes_through(
    runs: &[Run],
    i: usize,
    limits: &Limits,
    closed: bool,
    pierces: impl Fn((usize, f64)) -> bool,
    out: &mut [bool],
) {
    let [before, after] = beside(runs, i, closed);
    let backward = before.is_some_and(|run| run.state == State::Hidden);
    let begin = |run: &Run| if backward { run.to } else { run.from };
    out[i] = runs[i].length >= limits.stub && pierces(begin(&runs[i]));
    let leading = if backward { after } else { before };
    if !out[i] && leading.is_some_and(|run| run.state == State::Within && pierces(begin(run))) {
        let n = runs.len();
        out[i] = true;
        out[if backward { (i + 1) % n } else { (i + n - 1) % n }] = true;
    }
}

fn settle(mut runs: Runs, limits: &Limits, closed: bool, pierces: impl Fn((usize, f64)) -> bool) -> Runs {
    if let [run] = &runs[..]
        && matches!(run.state, State::Visible | State::Hidden)
    {
        // As of most lines: one run, whose state is known.
        return runs;
    }
    let mut through = vec![false; runs.len()];
    for i in (0..runs.len()).filter(|&i| runs[i].state == State::Diving) {
        goes_through(&runs, i, limits, closed, &pierces, &mut through);
    }
    // A contact is visible, however short. A D run of at least the stub length is a contact, too.
    let states: Vec<State> = (0..runs.len())
        .map(|i| match runs[i].state {
            _ if through[i] => State::Hidden,
            State::Within if !dives(&runs, i, limits.stub, closed) => State::Visible,
            State::Diving if runs[i].length >= limits.stub => State::Visible,
            State::Within | State::Diving => State::Hidden,
            known => known,
        })
        .collect();
    for (run, state) in runs.iter_mut().zip(states) {
        run.state = state;
    }
    rejoin(&mut runs);
    for i in 0..runs.len() {
        let between = beside(&runs, i, closed).iter().all(|r| r.is_some_and(|r| r.state == State::Visible));
        if runs[i].state == State::Hidden && runs[i].length < limits.noise && between {
            runs[i].state = State::Visible;
        }
    }
    rejoin(&mut runs);
    // The shortest first: a run that grows by a merge may then be long enough.
    while runs.len() > 1 {
        let Some(i) = (0..runs.len()).min_by(|&i, &j| runs[i].length.total_cmp(&runs[j].length)) else { break };
        let wraps = closed && runs.len() > 2 && runs[0].state == runs[runs.len() - 1].state;
        let ends = i == 0 || i + 1 == runs.len();
        if runs[i].length >= limits.short {
            break;
        }
        if wraps && ends && runs[0].length + runs[runs.len() - 1].length >= limits.short {
            // The first and the last run are one run, and together long enough: only inner runs are left to check.
            let shortest_inner = (1..runs.len() - 1).min_by(|&i, &j| runs[i].length.total_cmp(&runs[j].length));
            match shortest_inner {
                Some(k) if runs[k].length < limits.short => flip(&mut runs, k),
                _ => break,
            }
        } else {
            flip(&mut runs, i);
        }
        rejoin(&mut runs);
    }
    runs
}

fn flip(runs: &mut [Run], i: usize) {
    runs[i].state = if runs[i].state == State::Visible { State::Hidden } else { State::Visible };
}

/// The lines of one chain. `through`: whether the line goes through a surface at a point.
pub fn cut(
    geometry: &Geometry,
    edges: &[i32],
    reversed: &[bool],
    id: u32,
    limits: &Limits,
    through: &dyn Fn(&[f64; 3]) -> bool,
) -> Vec<Polyline> {
    let mut chain = Chain { geometry, edges, reversed, kept: Kept::default() };
    if limits.loops > 0.0 {
        chain.cut_off_loops(limits.loops);
    }
    let mut out = Vec::new();
    let stretches = chain.stretches();
    let closed = chain.closed(&stretches);
    for stretch in stretches {
        let mut runs = settle(stretch, limits, closed, |stop| through(&chain.at(stop).1));
        let last = runs.len() - 1;
        if closed && last > 0 && runs[0].state == runs[last].state {
            // Start a closed chain where its state changes, so that no line is cut at an arbitrary vertex.
            let tail = runs.remove(last);
            let head = runs.remove(0);
            for run in &runs {
                chain.add_lines(&[*run], id, limits.end_on, &mut out);
            }
            chain.add_lines(&[tail, head], id, limits.end_on, &mut out);
            continue;
        }
        for run in &runs {
            chain.add_lines(&[*run], id, limits.end_on, &mut out);
        }
    }
    out
}

#[cfg(test)]
mod tests;
