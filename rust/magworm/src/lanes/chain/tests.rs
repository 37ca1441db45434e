//! Chains against dense factorisations.

use super::*;
use crate::lanes::Scalar;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

/// A random chain: soft unknowns, bodies of `body` unknowns, entries where `reach` allows and no body lies between.
fn random(chain: &Chain, reach: usize, numbers: &[f64]) -> (DMatrix<f64>, Vec<[f64; 1]>) {
    let size = chain.place.len();
    let mut next = numbers.iter().cycle();
    let (mut dense, mut stored) = (DMatrix::zeros(size, size), vec![[0.0]; chain.entries()]);
    for row in 0..size {
        for column in row.saturating_sub(reach)..=row {
            let parts = (column..=row).map(|k| chain.place[k].map(|place| place / chain.body));
            // Neighbours only: a segment and the bodies at its ends, or a body and itself.
            let bodies: Vec<_> = parts.collect();
            let across = bodies.len() > 2
                && bodies[1..bodies.len() - 1].iter().any(|part| {
                    part.is_some() && *part != bodies[0] && part != bodies.last().expect("two ends")
                });
            let both = bodies[0].is_some() && bodies.last().expect("two ends").is_some();
            if across || both && bodies[0] != *bodies.last().expect("two ends") {
                continue;
            }
            let value = next.next().expect("a cycle") + if row == column { 30.0 } else { 0.0 };
            dense[(row, column)] = value;
            dense[(column, row)] = value;
            stored[chain.at(row, column)] = [value];
        }
    }
    (dense, stored)
}

fn solves(bodies: &[usize], body: usize, size: usize, reach: usize, numbers: &[f64]) -> f64 {
    let mut chain = Chain::condensed(size, bodies, body).expect("bodies of a worm");
    let mut free = 0;
    for &first in bodies.iter().chain([&size]) {
        // A segment with the body behind it.
        for row in free..(first + body).min(size) {
            let coupled = chain.couple(&[row.saturating_sub(reach).max(free), row]);
            coupled.expect("neighbours in reach");
        }
        free = first + body;
    }
    let (dense, mut matrix) = random(&chain, reach, numbers);
    let mut rhs: Vec<[f64; 1]> = (0..size).map(|k| [numbers[k % numbers.len()] + 0.5]).collect();
    let expected = DVector::from_iterator(size, rhs.iter().map(|r| r[0]));
    let expected = dense.lu().solve(&expected).expect("regular");
    chain.condense(Scalar, &mut matrix, &mut rhs);
    let kept = chain.kept();
    let mut own: Vec<[f64; 1]> = chain.kept_entries(&matrix)[..kept.entries()].to_vec();
    let mut found: Vec<[f64; 1]> = chain.unknowns().iter().map(|&k| rhs[k]).collect();
    kept.factor(Scalar, &mut own);
    kept.solve(Scalar, &own, &mut found);
    let mut solution = vec![[0.0]; size];
    chain.unknowns().iter().zip(found).for_each(|(&k, value)| solution[k] = value);
    chain.recover(Scalar, &matrix, &rhs, &mut solution);
    (0..size).map(|k| (solution[k][0] - expected[k]).abs()).fold(0.0, f64::max)
}

/// A new matrix is zeros, so a step that begins with a cleared one begins as the first did.
#[test]
fn a_matrix_that_was_eliminated_is_zeros_once_it_is_cleared() {
    for (size, bodies, body, reach) in [(33, [2, 11, 20], 3, 5), (68, [4, 23, 42], 6, 10)] {
        let mut chain = Chain::condensed(size, &bodies, body).expect("bodies of a worm");
        assert_eq!(chain.couple(&[0, 1]), Ok(()));
        let numbers: Vec<f64> = (0..97).map(|k| (f64::from(k) * 0.7).sin()).collect();
        let (_, mut matrix) = random(&chain, reach, &numbers);
        let mut rhs = vec![[1.0]; size];
        chain.condense(Scalar, &mut matrix, &mut rhs);
        chain.kept().factor(Scalar, &mut matrix[chain.start_of_kept()..]);
        assert!(matrix.iter().any(|row| row[0] != 0.0));
        chain.clear(Scalar, &mut matrix);
        assert!(matrix.iter().all(|row| row[0] == 0.0));
    }
}

#[test]
fn unknowns_beyond_the_compiled_kernels_are_told_and_change_nothing() {
    // Soft unknowns 0 to 3, 7 to 21 and 25 to 32 beside bodies at 4 and 22 in the plane.
    let mut chain = Chain::condensed(33, &[4, 22], 3).expect("bodies of a worm");
    assert_eq!(chain.couple(&[5, 10, 14]), Ok(()), "a body and what lies behind it");
    let before = chain.clone();
    for (unknowns, from, to, what) in [
        (&[8, 17][..], 8, 17, "more than eight apart in a segment"),
        (&[3, 7], 3, 7, "on both sides of a body"),
        (&[4, 25], 4, 25, "a body and a segment that does not begin at it"),
    ] {
        assert_eq!(chain.couple(unknowns), Err(OutOfReach { from, to }), "{what}");
        assert_eq!(chain, before, "{what}");
    }
    assert_eq!(Chain::condensed(100, &[0, 20], 9), Err(OutOfReach { from: 0, to: 28 }));
}

proptest! {
    #[test]
    fn chains_solve_like_a_dense_factorisation(
        numbers in prop::collection::vec(-1.0..1.0f64, 97),
        soft in prop::collection::vec(0usize..12, 4),
    ) {
        for (body, reach) in [(3, 6), (6, 13)] {
            let mut bodies = vec![soft[0]];
            for between in &soft[1..3] {
                bodies.push(bodies[bodies.len() - 1] + body + between);
            }
            let size = bodies[2] + body + soft[3];
            prop_assert!(solves(&bodies, body, size, reach, &numbers) < 1e-12);
        }
    }
}
