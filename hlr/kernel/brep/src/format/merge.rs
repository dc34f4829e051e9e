//! One dump of shapes from several files: the compound whose parts a model has.

use rustc_hash::FxHashMap;

use super::Dump;
use super::locations::Locations;
use super::pieces::Piece;
use super::record::Recorded;
use super::shapes::{Kind, Sub};
use super::tokens::{FLAGS, TABLES, Table};

/// A file that was read, with its tables in binary.
pub struct Source {
    pub dump: Dump,
    pub recorded: Recorded,
}

/// A part: a piece of one of the files.
pub struct Root<'a> {
    pub source: usize,
    pub piece: &'a Piece,
}

/// Before the shapes: the items of earlier files in each table.
type Before = [usize; TABLES.len()];

/// The dump of a compound of the roots. None where it would be longer than a dump can be.
pub fn merged(sources: &[&Source], roots: &[Root]) -> Option<Vec<u8>> {
    let kept: Vec<Vec<Option<usize>>> = sources.iter().map(|source| kept_triangulations(source)).collect();
    let mut more: Vec<Numbers> = sources.iter().map(|source| Numbers::new(&source.dump.locations)).collect();
    for root in roots.iter().filter(|root| root.piece.loose) {
        root.piece.subs.iter().for_each(|sub| more[root.source].add(sub.location));
    }
    let mut starts: Vec<Before> = vec![[0; TABLES.len()]];
    for ((source, kept), more) in sources.iter().zip(&kept).zip(&more) {
        let mut after = starts[starts.len() - 1];
        for (k, table) in TABLES.into_iter().enumerate() {
            after[k] += match table {
                Table::Locations => source.recorded.sections[k].count + more.added.len(),
                Table::Triangulations => kept.iter().flatten().count(),
                _ => source.recorded.sections[k].count,
            };
        }
        starts.push(after);
    }
    let compounds = roots.iter().filter(|root| root.piece.loose).count();
    let mut all = *starts.last()?;
    let of_files = all[Table::Shapes as usize];
    all[Table::Shapes as usize] += compounds + 1;
    let total = i32::try_from(all[Table::Shapes as usize]).ok()?;

    let mut out = b"\nOpen CASCADE Topology V4, (c) Open Cascade\n".to_vec();
    for (k, table) in TABLES.into_iter().enumerate() {
        if table == Table::Shapes {
            out.push(b'\n');
        }
        out.extend(format!("{} {}\n", table.name(), all[k]).bytes());
        for (i, source) in sources.iter().enumerate() {
            match table {
                Table::Triangulations => put_triangulations(source, &kept[i], &mut out),
                _ => put_section(source, k, &starts[i], &kept[i], total, &mut out),
            }
            if table == Table::Locations {
                more[i].put(&source.dump.locations, starts[i][0], &mut out);
            }
        }
    }
    // Shapes are numbered from the last one: the whole, then the compounds, the latest first.
    let number = |source: usize, shape: u32| total - (starts[source][Table::Shapes as usize] + shape as usize) as i32;
    let mut children = Vec::new();
    let mut next = total - of_files as i32;
    for root in roots {
        if !root.piece.loose {
            children
                .extend(root.piece.subs.iter().map(|sub| (sub.orientation as u8, number(root.source, sub.shape), 0)));
            continue;
        }
        let placed = |sub: &Sub| {
            let location = more[root.source].known[&sub.location];
            let location = if location == 0 { 0 } else { (starts[root.source][0] + location as usize) as i32 };
            (sub.orientation as u8, number(root.source, sub.shape), location)
        };
        put_compound(&root.piece.subs.iter().map(placed).collect::<Vec<_>>(), &mut out);
        children.push((0, next, 0));
        next -= 1;
    }
    put_compound(&children, &mut out);
    put_sub((0, 1, 0), &mut out);
    Some(out)
}

/// Orientation, number, location.
type WrittenSub = (u8, i32, i32);

fn put_compound(subs: &[WrittenSub], out: &mut Vec<u8>) {
    out.push(0);
    out.extend([1, 1].iter().chain(&[0; FLAGS - 2]));
    subs.iter().for_each(|sub| put_sub(*sub, out));
    out.push(b'*');
}

fn put_sub((orientation, number, location): WrittenSub, out: &mut Vec<u8>) {
    out.push(orientation);
    out.extend(number.to_le_bytes());
    out.extend(location.to_le_bytes());
}

/// Numbers in the table of a file, with those behind it of locations that it lacks.
struct Numbers {
    known: FxHashMap<u32, u32>,
    next: u32,
    added: Vec<u32>,
}

impl Numbers {
    fn new(locations: &Locations) -> Numbers {
        Numbers { known: locations.in_dump(), next: locations.count() as u32, added: Vec::new() }
    }

    fn add(&mut self, location: u32) {
        self.known.entry(location).or_insert_with(|| {
            self.added.push(location);
            self.next += 1;
            self.next - 1
        });
    }

    fn put(&self, known: &Locations, before: usize, out: &mut Vec<u8>) {
        for location in &self.added {
            out.push(2);
            for (number, power) in known.factors(*location) {
                out.extend(((before + number as usize) as i32).to_le_bytes());
                out.extend(power.to_le_bytes());
            }
            out.extend(0i32.to_le_bytes());
        }
    }
}

/// New numbers, counted from 0, of the triangulations that are all a face has; None for the others.
fn kept_triangulations(source: &Source) -> Vec<Option<usize>> {
    let mut kept = vec![None; source.dump.triangulations.len()];
    for shape in &source.dump.shapes {
        if let Kind::Face { surface: None, triangulation: Some(number), .. } = shape.kind {
            kept[number] = Some(0);
        }
    }
    for (new, own) in kept.iter_mut().flatten().enumerate() {
        *own = new;
    }
    kept
}

/// The end of the bytes of a table: where the next one begins.
fn end(recorded: &Recorded, k: usize) -> usize {
    recorded.sections.get(k + 1).map_or(recorded.bytes.len(), |next| next.begin)
}

fn put_triangulations(source: &Source, kept: &[Option<usize>], out: &mut Vec<u8>) {
    let recorded = &source.recorded;
    let last = end(recorded, Table::Triangulations as usize);
    let ends = recorded.triangulations.iter().skip(1).copied().chain([last]);
    for ((begin, end), kept) in recorded.triangulations.iter().zip(ends).zip(kept) {
        if kept.is_some() {
            out.extend(&recorded.bytes[*begin..end]);
        }
    }
}

fn put_section(source: &Source, k: usize, before: &Before, kept: &[Option<usize>], total: i32, out: &mut Vec<u8>) {
    let recorded = &source.recorded;
    let shapes = recorded.sections[Table::Shapes as usize].count;
    let begin = recorded.sections[k].begin;
    // The root of the file stands behind its shapes.
    let end = if k == Table::Shapes as usize { recorded.bytes.len() - ROOT } else { end(recorded, k) };
    let shift = out.len();
    out.extend(&recorded.bytes[begin..end]);
    let first = recorded.marks.partition_point(|(at, _)| *at < begin);
    for (at, table) in recorded.marks[first..].iter().take_while(|(at, _)| *at < end) {
        let place = &mut out[shift + at - begin..][..4];
        let number = i32::from_le_bytes([place[0], place[1], place[2], place[3]]) as usize;
        let before = before[*table as usize];
        let new = match table {
            Table::Shapes => total - (before + shapes - number) as i32,
            Table::Triangulations => (before + kept[number - 1].map_or(0, |new| new + 1)) as i32,
            _ => (before + number) as i32,
        };
        place.copy_from_slice(&new.to_le_bytes());
    }
}

/// Bytes of a sub-shape: orientation, number, location.
const ROOT: usize = 9;
