//! Locations of sub-shapes, composed, compared and cancelled exactly as TopLoc_Location does it.
//!
//! OpenCASCADE treats two sub-shapes as the same when their underlying shape and their *location* agree. A location is
//! not a matrix but a chain of elementary transformations with powers. Two chains with equal matrices may differ; a
//! chain times its inverse cancels. The index maps of a part depend on this, so chains are composed here.

use rustc_hash::FxHashMap;

use super::tokens::{Read, Table, Tokens};

/// Elementary transformations with their powers, from the outermost to the innermost.
type Chain = Vec<(u32, i32)>;
pub type Matrix = [[f64; 4]; 3];

/// Limit on the length of a chain and on its powers; a file that exceeds it is damaged.
const LONGEST: usize = 1000;

/// Limit on the factors of all locations together.
pub const MOST_FACTORS: usize = 50_000_000;

/// A growing table of locations; number 0 is the identity. Equal chains have equal numbers.
#[derive(Clone, Debug)]
pub struct Locations {
    datums: Vec<Matrix>,
    chains: Vec<Chain>,
    numbers: FxHashMap<Chain, u32>,
    products: FxHashMap<(u32, u32), u32>,
    matrices: FxHashMap<u32, Matrix>,
    factors: usize,
    /// Numbers in this table by numbers in the dump.
    written: Vec<u32>,
    /// Numbers in the dump of the elementary transformations.
    elementary: Vec<u32>,
}

pub fn read(bytes: &mut impl Tokens) -> Read<Locations> {
    let count = bytes.header(Table::Locations, 5)?;
    let mut all = Locations::none();
    for _ in 0..count {
        match bytes.kind()? {
            1 => {
                all.add_move(bytes.placement()?);
            }
            2 => {
                let mut factors = Vec::new();
                loop {
                    let number = bytes.number(Table::Locations)?;
                    if number == 0 {
                        break;
                    }
                    // Each is a location written earlier.
                    match u32::try_from(number) {
                        Ok(number) if (number as usize) < all.written.len() => factors.push((number, bytes.integer()?)),
                        _ => return bytes.fault("a location of nothing"),
                    }
                    if factors.len() > LONGEST {
                        return bytes.fault("a location of too many moves");
                    }
                }
                if all.add_product(&factors).is_none() {
                    return bytes.fault("a location of too many moves");
                }
            }
            _ => return bytes.fault("a location of unknown kind"),
        }
    }
    Ok(all)
}

fn inverse(chain: &Chain) -> Chain {
    chain.iter().rev().map(|&(datum, power)| (datum, -power)).collect()
}

/// Merges only neighbours of the same elementary transformation, as TopLoc_Location::Multiplied does.
fn composed(outer: &Chain, inner: &Chain) -> Chain {
    let mut chain = outer.clone();
    for &(datum, power) in inner {
        let total = match chain.last() {
            Some(&(last, before)) if last == datum => {
                chain.pop();
                before.saturating_add(power)
            }
            _ => power,
        };
        if total != 0 {
            chain.push((datum, total));
        }
    }
    chain
}

impl Locations {
    /// The identity alone.
    pub fn none() -> Locations {
        Locations {
            datums: Vec::new(),
            chains: vec![Vec::new()],
            numbers: FxHashMap::from_iter([(Vec::new(), 0)]),
            products: FxHashMap::default(),
            matrices: FxHashMap::default(),
            factors: 0,
            written: vec![0],
            elementary: Vec::new(),
        }
    }

    /// Adds an elementary transformation of the dump; its number there.
    pub fn add_move(&mut self, place: Matrix) -> u32 {
        self.datums.push(place);
        self.elementary.push(self.written.len() as u32);
        self.add(vec![(self.datums.len() as u32 - 1, 1)])
    }

    /// Adds a location of the dump: of numbers there and powers, from the innermost to the outermost. None where it has
    /// too many moves.
    pub fn add_product(&mut self, factors: &[(u32, i32)]) -> Option<u32> {
        let mut chain = Chain::new();
        for &(number, power) in factors {
            let factor = &self.chains[self.written[number as usize] as usize];
            let times = power.unsigned_abs() as usize;
            if times > LONGEST || chain.len() + times * factor.len() > LONGEST {
                return None;
            }
            let one = if power < 0 { inverse(factor) } else { factor.clone() };
            for _ in 0..times {
                chain = composed(&one, &chain);
            }
        }
        Some(self.add(chain))
    }

    fn add(&mut self, chain: Chain) -> u32 {
        let number = self.number(chain);
        self.written.push(number);
        self.written.len() as u32 - 1
    }

    /// Number of locations in the dump, including the identity.
    pub fn count(&self) -> usize {
        self.written.len()
    }

    /// The number in this table of a location with the given number in the dump.
    pub fn written(&self, number: u32) -> u32 {
        self.written[number as usize]
    }

    /// Factors of all locations together.
    pub fn factors_in_all(&self) -> usize {
        self.factors
    }

    /// Numbers in the dump by numbers in this table.
    pub fn in_dump(&self) -> FxHashMap<u32, u32> {
        let mut numbers = FxHashMap::default();
        (0..).zip(&self.written).for_each(|(written, own)| {
            numbers.entry(*own).or_insert(written);
        });
        numbers
    }

    /// The factors of a location, from the innermost to the outermost: numbers in the dump, and powers.
    pub fn factors(&self, number: u32) -> impl Iterator<Item = (u32, i32)> {
        self.chains[number as usize].iter().rev().map(|&(datum, power)| (self.elementary[datum as usize], power))
    }

    fn number(&mut self, chain: Chain) -> u32 {
        if let Some(&known) = self.numbers.get(&chain) {
            return known;
        }
        let number = self.chains.len() as u32;
        self.factors += chain.len();
        self.chains.push(chain.clone());
        self.numbers.insert(chain, number);
        number
    }

    /// The location outer * inner.
    pub fn product(&mut self, outer: u32, inner: u32) -> u32 {
        if outer == 0 || inner == 0 {
            return outer + inner;
        }
        if let Some(&known) = self.products.get(&(outer, inner)) {
            return known;
        }
        let chain = composed(&self.chains[outer as usize], &self.chains[inner as usize]);
        let number = self.number(chain);
        self.products.insert((outer, inner), number);
        number
    }

    /// The location outer^-1 * inner.
    pub fn quotient(&mut self, outer: u32, inner: u32) -> u32 {
        if outer == 0 {
            return inner;
        }
        let back = inverse(&self.chains[outer as usize]);
        let back = self.number(back);
        self.product(back, inner)
    }

    pub fn matrix(&mut self, number: u32) -> Matrix {
        if let Some(known) = self.matrices.get(&number) {
            return *known;
        }
        let mut matrix = IDENTITY;
        for &(datum, power) in &self.chains[number as usize] {
            let step = self.datums[datum as usize];
            let step = if power > 0 { step } else { inverted(&step) };
            for _ in 0..power.unsigned_abs().min(LONGEST as u32) {
                matrix = chained(&matrix, &step);
            }
        }
        self.matrices.insert(number, matrix);
        matrix
    }
}

pub const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// The transformation by `inner`, then by `outer`.
pub fn chained(outer: &Matrix, inner: &Matrix) -> Matrix {
    outer.map(|[a, b, c, d]| {
        [0, 1, 2, 3].map(|j| a * inner[0][j] + b * inner[1][j] + c * inner[2][j] + if j == 3 { d } else { 0.0 })
    })
}

pub fn determinant(m: &Matrix) -> f64 {
    (0..3).map(|k| m[0][k] * cofactor(m, k, 0)).sum()
}

fn cofactor(m: &Matrix, i: usize, j: usize) -> f64 {
    let (j1, j2, i1, i2) = ((j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3);
    m[j1][i1] * m[j2][i2] - m[j1][i2] * m[j2][i1]
}

pub fn inverted(m: &Matrix) -> Matrix {
    let determinant = determinant(m);
    [0, 1, 2].map(|i| {
        let [a, b, c] = [0, 1, 2].map(|j| cofactor(m, i, j) / determinant);
        [a, b, c, -(a * m[0][3] + b * m[1][3] + c * m[2][3])]
    })
}

pub fn moved(m: &Matrix, [x, y, z]: &[f64; 3]) -> [f64; 3] {
    m.map(|[a, b, c, d]| a * x + b * y + c * z + d)
}

/// Transforms a direction: rotation and scale without translation.
pub fn turned(m: &Matrix, [x, y, z]: &[f64; 3]) -> [f64; 3] {
    m.map(|[a, b, c, _]| a * x + b * y + c * z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_move_and_its_inverse_cancel() {
        let turn = [[0.0, -1.0, 0.0, 3.0], [1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 5.0]];
        assert_eq!(chained(&turn, &inverted(&turn)), IDENTITY);
        let mut all = Locations {
            datums: vec![turn, IDENTITY],
            chains: vec![vec![], vec![(0, 1)], vec![(0, 1), (1, 1)]],
            numbers: FxHashMap::from_iter([(vec![], 0), (vec![(0, 1)], 1), (vec![(0, 1), (1, 1)], 2)]),
            products: FxHashMap::default(),
            matrices: FxHashMap::default(),
            factors: 0,
            written: vec![0, 1, 2],
            elementary: vec![1, 2],
        };
        assert_eq!(all.quotient(1, 1), 0);
        let inner = all.quotient(1, 2);
        assert_eq!(all.product(1, inner), 2);
        assert_eq!(all.matrix(2), turn);
    }
}
