//! From the model to facets on the screen: project, clip, round, plane, cull, triangulate. Every method starts here.

use super::back_face::{Facing, facing};
use super::clip::{Corner, Wall, clip_loop, walls};
use super::plane::{DEPTH_LIMIT, LIMIT, Plane, Point, STEPS, centre};
use super::scene::{Camera, Rule, Scene};
use super::statistics::Statistics;
use super::triangulate::triangulate;
use super::watch::Watch;
use std::cmp::Ordering;
use std::ops::Range;

/// No facet: the background.
pub const NONE: u32 = u32::MAX;

/// Two depths closer than this many steps are compared in integers. Floating point is wrong by less: below 2^32 steps, added
/// up pixel by pixel, it is off by at most 2^-8 at the end of a row of 8192 pixels.
pub const NEAR_TIE: f64 = 1.0 / 64.0;
/// Facets so steep that floating point might be off by more have no depth in floating point.
const STEEP: f64 = (1u64 << 32) as f64;

/// A planar polygon on the screen.
#[derive(Clone, Debug)]
pub struct Facet {
    /// The polygon it is of.
    pub id: u32,
    /// Its loops: range into `Screen::loops`.
    pub loops: Range<u32>,
    /// With C > 0.
    pub plane: Plane,
    /// Pixels whose centres may lie inside: columns and rows, end exclusive, within the frame.
    pub columns: [i32; 2],
    pub rows: [i32; 2],
    /// Least and greatest depth.
    pub depth: [i32; 2],
    /// Depth in floating point: at pixel (columns[0], rows[0]), and per pixel right and down. NaN where it is steep.
    pub start: f64,
    pub right: f64,
    pub down: f64,
    /// How far rounding may have moved the plane in depth: the window in which a painter's order is not trusted.
    pub slack: f32,
}

impl Facet {
    /// Depth at a pixel's centre within `NEAR_TIE` / 2, or NaN.
    #[inline(always)]
    pub fn depth_at(&self, column: i64, row: i64) -> f64 {
        self.start
            + self.right * (column - i64::from(self.columns[0])) as f64
            + self.down * (row - i64::from(self.rows[0])) as f64
    }
}

/// Facets in the order of their polygons: of two at the same depth the lower number wins.
pub struct Screen {
    pub width: i64,
    pub height: i64,
    pub rule: Rule,
    pub points: Vec<Point>,
    /// Per point: the value to interpolate, and 1 / w of the perspective; empty unless values were given.
    pub values: Vec<[f64; 4]>,
    /// Runs of `points`.
    pub loops: Vec<Range<u32>>,
    pub facets: Vec<Facet>,
    /// Depth of a step and of zero.
    pub depth_step: f64,
    pub depth_zero: f64,
}

impl Screen {
    pub fn loops_of<'a>(&'a self, facet: &'a Facet) -> impl Iterator<Item = &'a [Point]> + Clone {
        self.loops[facet.loops.start as usize..facet.loops.end as usize]
            .iter()
            .map(|l| &self.points[l.start as usize..l.end as usize])
    }

    /// Nearer first; at equal depth the lower facet. Exact, whatever floating point makes of it.
    #[inline(always)]
    pub fn compare(&self, f: u32, g: u32, column: i64, row: i64, statistics: &mut Statistics) -> Ordering {
        let (a, b) = (&self.facets[f as usize], &self.facets[g as usize]);
        statistics.comparisons += 1;
        let difference = a.depth_at(column, row) - b.depth_at(column, row);
        if difference > NEAR_TIE {
            return Ordering::Greater;
        }
        if difference < -NEAR_TIE {
            return Ordering::Less;
        }
        self.compare_exactly(f, g, column, row, statistics)
    }

    #[cold]
    pub fn compare_exactly(&self, f: u32, g: u32, column: i64, row: i64, statistics: &mut Statistics) -> Ordering {
        statistics.exact += 1;
        let (a, b) = (&self.facets[f as usize], &self.facets[g as usize]);
        a.plane.compare(&b.plane, centre(column), centre(row)).then(f.cmp(&g))
    }

    /// Depth of a facet at a pixel's centre, in the units of the camera.
    pub fn true_depth(&self, f: u32, column: i64, row: i64) -> f64 {
        let plane = &self.facets[f as usize].plane;
        let n = plane.depth(centre(column), centre(row));
        let c = i128::from(plane.c);
        // Whole steps and the rest apart: exact for whole numbers, correct to the last bits else.
        let (whole, rest) = (n.div_euclid(c), n.rem_euclid(c));
        (whole as f64 + rest as f64 / c as f64) * self.depth_step + self.depth_zero
    }

    pub fn bytes(&self) -> usize {
        use super::statistics::bytes_of;
        bytes_of(&self.points) + bytes_of(&self.loops) + bytes_of(&self.facets)
    }
}

/// What becomes of polygons whose corners rounding has moved out of their plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bent {
    /// Triangles, which are exact: for pictures.
    Triangulated,
    /// They stay in one piece, in Newell's plane: for lists of polygons, where a little depth does not matter.
    Whole,
}

/// The scene before the camera, or None if there was no time.
pub fn screen(
    scene: &Scene,
    camera: &Camera,
    bent: Bent,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<Screen> {
    // 1. project all points; which of them lie outside which wall
    let (frame, guard) =
        (walls(camera, 0.0), walls(camera, LIMIT / STEPS as f64 - f64::from(camera.width.max(camera.height))));
    let projected: Vec<[f64; 4]> = scene.points.iter().map(|p| camera.project(p)).collect();
    let codes = |walls: &[Wall]| -> Vec<u8> { projected.iter().map(|p| outcode(p, walls)).collect() };
    let (unseen, outside) = (codes(&frame), codes(&guard));
    // 2. clip; project
    let mut flat = Flat::default();
    let mut work = Vec::new();
    for polygon in 0..scene.len() {
        if watch.over() {
            return None;
        }
        match crossed(scene, polygon, &unseen, &outside) {
            Place::Beyond => statistics.clipped += 1,
            // Mostly nothing crosses anything: no loop is copied then.
            Place::Within => {
                flat.add(polygon, scene.loops_of(polygon).map(|l| l.iter().map(|&i| corner(scene, &projected, i))))
            }
            Place::Crossing(crossed) => {
                statistics.clipped += 1;
                clipped(scene, polygon, &projected, crossed, &guard, &mut work);
                flat.add(polygon, work.iter().map(|l| l.iter().copied()));
            }
        }
    }
    statistics.polygons = scene.len() as u64;
    // 3. round, with one step of depth for all
    let (zero, step) = depth_grid(camera, &flat);
    let mut out = Screen {
        width: i64::from(camera.width),
        height: i64::from(camera.height),
        rule: scene.rule,
        points: flat.points.iter().map(|p| snap(p, zero, step)).collect(),
        values: if scene.values.is_empty() { Vec::new() } else { flat.values },
        loops: Vec::with_capacity(flat.loops.len()),
        facets: Vec::with_capacity(flat.polygons.len()),
        depth_step: step,
        depth_zero: zero,
    };
    // 4. planes, culling, triangles where there is no plane
    for (id, loops) in &flat.polygons {
        if watch.over() {
            return None;
        }
        let range = loops.start as usize..loops.end as usize;
        out.add(*id, &flat.loops[range], &flat.points, scene.cull[*id as usize], bent, statistics);
    }
    statistics.facets = out.facets.len() as u64;
    Some(out)
}

fn outcode(p: &[f64; 4], walls: &[Wall]) -> u8 {
    // What is not a number is inside nothing.
    walls.iter().enumerate().fold(0, |code, (k, wall)| if wall.height(p) >= 0.0 { code } else { code | 1 << k })
}

/// Where a polygon lies: wholly beyond one plane of the view volume; across some of the walls, as bits; or neither.
enum Place {
    Beyond,
    Within,
    Crossing(u8),
}

fn crossed(scene: &Scene, polygon: usize, unseen: &[u8], outside: &[u8]) -> Place {
    let (mut any, mut all) = (0u8, u8::MAX);
    for &i in scene.loops_of(polygon).flatten() {
        any |= outside[i as usize];
        all &= unseen[i as usize];
    }
    match (all, any) {
        (0, 0) => Place::Within,
        (0, _) => Place::Crossing(any),
        _ => Place::Beyond,
    }
}

fn corner(scene: &Scene, projected: &[[f64; 4]], i: i32) -> Corner {
    let value = scene.values.get(i as usize).copied().unwrap_or([0.0; 3]);
    Corner { at: projected[i as usize], value }
}

/// The loops of one polygon within the walls that it crosses; those that come out empty are left out.
fn clipped(
    scene: &Scene,
    polygon: usize,
    projected: &[[f64; 4]],
    crossed: u8,
    walls: &[Wall],
    out: &mut Vec<Vec<Corner>>,
) {
    out.clear();
    out.extend(scene.loops_of(polygon).map(|l| l.iter().map(|&i| corner(scene, projected, i)).collect::<Vec<_>>()));
    let mut next = Vec::new();
    for wall in walls.iter().enumerate().filter(|(k, _)| crossed >> k & 1 != 0).map(|(_, wall)| wall) {
        for l in out.iter_mut() {
            clip_loop(l, wall, &mut next);
            std::mem::swap(l, &mut next);
        }
    }
    out.retain(|l| l.len() > 2);
}

/// Clipped polygons after the division: pixels and depth, not yet rounded.
#[derive(Default)]
struct Flat {
    points: Vec<[f64; 3]>,
    values: Vec<[f64; 4]>,
    loops: Vec<Range<u32>>,
    polygons: Vec<(u32, Range<u32>)>,
}

impl Flat {
    fn add(&mut self, polygon: usize, loops: impl Iterator<Item = impl Iterator<Item = Corner>>) {
        let first = self.loops.len() as u32;
        for l in loops {
            let start = self.points.len() as u32;
            for c in l {
                let [u, v, q, w] = c.at;
                self.points.push([u / w, v / w, q / w]);
                self.values.push([c.value[0], c.value[1], c.value[2], 1.0 / w]);
            }
            self.loops.push(start..self.points.len() as u32);
        }
        if self.loops.len() as u32 > first {
            self.polygons.push((polygon as u32, first..self.loops.len() as u32));
        }
    }
}

/// Depth of zero and of one step: the finest power of two for which all depths fit.
fn depth_grid(camera: &Camera, flat: &Flat) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for p in &flat.points {
        low = low.min(p[2]);
        high = high.max(p[2]);
    }
    if camera.image_space && camera.front.is_finite() && camera.back.is_finite() {
        (low, high) = (camera.front, camera.back);
    }
    if low > high {
        return (0.0, 1.0);
    }
    let mut step = 1.0f64;
    while (high - low) > DEPTH_LIMIT * step {
        step *= 2.0;
    }
    while (high - low) <= DEPTH_LIMIT * step * 0.5 && step > 1e-200 && high > low {
        step *= 0.5;
    }
    (low, step)
}

fn snap(p: &[f64; 3], zero: f64, step: f64) -> Point {
    let at = |v: f64| (v * STEPS as f64).round_ties_even().clamp(-LIMIT, LIMIT) as i32;
    [at(p[0]), at(p[1]), ((p[2] - zero) / step).round_ties_even().clamp(0.0, DEPTH_LIMIT) as i32]
}

impl Screen {
    /// One polygon, in as many facets as it takes.
    fn add(
        &mut self,
        id: u32,
        loops: &[Range<u32>],
        exact: &[[f64; 3]],
        cull: bool,
        bent: Bent,
        statistics: &mut Statistics,
    ) {
        let runs = loops.iter().map(|l| &self.points[l.start as usize..l.end as usize]);
        let plane = Plane::newell(runs.clone());
        let corners = loops.iter().map(|l| l.len()).sum::<usize>();
        let planar = corners == 3 || runs.clone().flatten().all(|p| plane.at(p) == 0);
        match facing(&plane) {
            Facing::EdgeOn if planar => {
                statistics.edge_on += 1;
                return;
            }
            Facing::Back if cull => {
                statistics.culled += 1;
                return;
            }
            _ => {}
        }
        let slack = self.slack(loops, exact);
        if planar || (bent == Bent::Whole && facing(&plane) != Facing::EdgeOn) {
            self.push(id, loops, plane, slack);
            return;
        }
        let ranges: Vec<_> = loops.iter().map(|l| l.start as usize..l.end as usize).collect();
        let Some(triangles) = triangulate(&self.points, &ranges, self.rule) else {
            if facing(&plane) != Facing::EdgeOn {
                self.push(id, loops, plane, slack);
            }
            return;
        };
        statistics.triangulated += 1;
        for t in triangles {
            let start = self.points.len() as u32;
            for i in t {
                self.points.push(self.points[i]);
                if !self.values.is_empty() {
                    self.values.push(self.values[i]);
                }
            }
            let plane = Plane::newell([&self.points[start as usize..]].into_iter());
            if facing(&plane) != Facing::EdgeOn {
                self.push(id, std::slice::from_ref(&(start..start + 3)), plane, slack);
            }
        }
    }

    /// How far the rounded plane may lie from the true one within the polygon, in steps of depth: half a step, and half a
    /// step of the image (along the diagonal) times the slope of the true plane.
    fn slack(&self, loops: &[Range<u32>], exact: &[[f64; 3]]) -> f32 {
        let mut n = [0.0f64; 3];
        for l in loops {
            let l = &exact[l.start as usize..l.end as usize];
            let mut p = &l[l.len() - 1];
            for q in l {
                n[0] += (p[1] - q[1]) * (p[2] + q[2] - 2.0 * l[0][2]);
                n[1] += (p[2] - q[2]) * (p[0] + q[0] - 2.0 * l[0][0]);
                n[2] += (p[0] - q[0]) * (p[1] + q[1] - 2.0 * l[0][1]);
                p = q;
            }
        }
        let slope = n[0].hypot(n[1]) / n[2].abs() / (STEPS as f64 * self.depth_step);
        let slack = 1.0 + slope;
        // Twice, for two facets of one polygon that is not quite planar; without a slope nothing is trusted.
        if slack.is_finite() { (2.0 * slack) as f32 } else { f32::INFINITY }
    }

    fn push(&mut self, id: u32, loops: &[Range<u32>], plane: Plane, slack: f32) {
        let (mut low, mut high) = ([i32::MAX; 3], [i32::MIN; 3]);
        let facing = plane.facing();
        for l in loops {
            for p in &self.points[l.start as usize..l.end as usize] {
                // The plane's own depth at its corners, which is that of the corners unless the polygon is warped.
                let n = facing.depth(i64::from(p[0]), i64::from(p[1]));
                let c = i128::from(facing.c);
                let z = [n.div_euclid(c), -(-n).div_euclid(c)].map(|z| z.clamp(-(1 << 30), 1 << 30) as i32);
                for k in 0..2 {
                    low[k] = low[k].min(p[k]);
                    high[k] = high[k].max(p[k]);
                }
                low[2] = low[2].min(z[0]);
                high[2] = high[2].max(z[1]);
            }
        }
        let columns = [first_centre(low[0]).max(0), first_centre(high[0]).min(self.width as i32)];
        let rows = [first_centre(low[1]).max(0), first_centre(high[1]).min(self.height as i32)];
        // Between the centres there is nothing to see. A triangle without a column may still matter to nobody.
        if columns[0] >= columns[1] || rows[0] >= rows[1] {
            return;
        }
        let first = self.loops.len() as u32;
        self.loops.extend_from_slice(loops);
        let c = facing.c as f64;
        let start = facing.depth(centre(columns[0].into()), centre(rows[0].into())) as f64 / c;
        let (right, down) = (-(facing.a as f64) * STEPS as f64 / c, -(facing.b as f64) * STEPS as f64 / c);
        let reach =
            start.abs() + right.abs() * f64::from(columns[1] - columns[0]) + down.abs() * f64::from(rows[1] - rows[0]);
        self.facets.push(Facet {
            id,
            loops: first..self.loops.len() as u32,
            plane: facing,
            columns,
            rows,
            depth: [low[2], high[2]],
            start: if reach < STEEP { start } else { f64::NAN },
            right,
            down,
            slack,
        });
    }
}

/// The first pixel whose centre is not before x.
pub fn first_centre(x: i32) -> i32 {
    let steps = STEPS as i32;
    (x - steps / 2).div_euclid(steps) + i32::from((x - steps / 2).rem_euclid(steps) != 0)
}
