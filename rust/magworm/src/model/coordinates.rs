//! Unknowns of the equations of motion and how the nodes hang on them.
//!
//! *Reduced*: a free node has (x, y); a rigid magnet has (x, y, θ) and carries its two end nodes.
//! *With multipliers* (the paper): every node has (x, y), each magnet (x, y, θ), and each end of a
//! magnet two Lagrange multipliers that tie the node to it. Unknowns are numbered along the body,
//! so that every matrix is banded.

use super::mesh::Mesh;
use crate::lanes::banded::Band;

/// Which unknowns are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknowns {
    /// Rigid magnets eliminated.
    Reduced,
    /// Rigid magnets tied by Lagrange multipliers.
    Multipliers,
}

/// How a node follows the unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its x is unknown `dof`, its y the next.
    Free {
        /// Unknown of x.
        dof: usize,
    },
    /// Rigidly on a magnet, `arm` (±½ length) along its axis.
    Rigid {
        /// The magnet.
        body: usize,
        /// −1 at the magnet's head end, 1 at its tail end.
        side: i8,
    },
    /// Held in place.
    Fixed,
}

/// A node tied to a magnet by two multipliers.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    /// First multiplier (x); y is the next.
    pub dof: usize,
    /// The tied node.
    pub node: usize,
    /// The magnet.
    pub body: usize,
    /// −1 at the magnet's head end, 1 at its tail end.
    pub side: i8,
}

/// The numbering of the unknowns.
#[derive(Clone, Debug)]
pub struct Coordinates {
    /// Number of unknowns.
    pub count: usize,
    /// For each node.
    pub anchors: Vec<Anchor>,
    /// First unknown (x, then y, θ) of each magnet.
    pub bodies: Vec<usize>,
    /// Multipliers; none in reduced coordinates.
    pub ties: Vec<Tie>,
}

impl Coordinates {
    /// Numbers the unknowns of a mesh.
    pub fn new(mesh: &Mesh, unknowns: Unknowns) -> Self {
        let nodes = mesh.arc_m.len();
        let mut this = Self { count: 0, anchors: Vec::new(), bodies: Vec::new(), ties: Vec::new() };
        let ends = magnet_ends(mesh);
        for node in 0..nodes {
            match ends[node] {
                Some((body, side)) => this.number_magnet_end(node, body, side, unknowns),
                None if node < mesh.fixed_nodes => this.anchors.push(Anchor::Fixed),
                None => this.number_free(),
            }
        }
        this
    }

    fn number_free(&mut self) {
        let dof = self.take(2);
        self.anchors.push(Anchor::Free { dof });
    }

    fn number_magnet_end(&mut self, node: usize, body: usize, side: i8, unknowns: Unknowns) {
        let head = side < 0;
        match unknowns {
            Unknowns::Reduced => {
                if head {
                    let dof = self.take(3);
                    self.bodies.push(dof);
                }
                self.anchors.push(Anchor::Rigid { body, side });
            }
            // The order node, tie, magnet, tie, node keeps the matrix banded and lets it be
            // factored without pivoting: each tie follows something with mass.
            Unknowns::Multipliers => {
                if head {
                    self.number_free();
                }
                let dof = self.take(2);
                self.ties.push(Tie { dof, node, body, side });
                if head {
                    let dof = self.take(3);
                    self.bodies.push(dof);
                } else {
                    self.number_free();
                }
            }
        }
    }

    fn take(&mut self, count: usize) -> usize {
        self.count += count;
        self.count - count
    }
}

/// For each node the magnet it ends and at which side. Magnets never share a node (validated).
fn magnet_ends(mesh: &Mesh) -> Vec<Option<(usize, i8)>> {
    let mut ends = vec![None; mesh.arc_m.len()];
    for (body, magnet) in mesh.magnets.iter().enumerate() {
        ends[magnet.element] = Some((body, -1));
        ends[magnet.element + 1] = Some((body, 1));
    }
    ends
}

/// The unknowns that up to three nodes hang on, in ascending order, and where each node's part is.
#[derive(Clone, Copy, Debug)]
pub struct Stencil {
    /// The nodes.
    pub nodes: [usize; 3],
    /// How many of them are used.
    pub node_count: usize,
    /// The unknowns.
    pub dofs: [usize; 9],
    /// How many of them are used.
    pub count: usize,
    /// Place in `dofs` of each node's x (y is the next, θ of a rigid one the third).
    pub slots: [usize; 3],
    /// The magnet each node is rigidly on.
    pub body: [Option<usize>; 3],
    /// First unknown of that magnet.
    pub body_dofs: [usize; 3],
    /// Whether each node can move.
    pub moves: [bool; 3],
    /// Places in the banded matrix of all pairs of unknowns, lower triangle by rows.
    pub entries: [usize; 45],
}

impl Stencil {
    /// The stencil of `nodes`, which must be consecutive along the body.
    pub fn new(coordinates: &Coordinates, nodes: &[usize]) -> Self {
        let mut this = Self {
            nodes: [0; 3],
            node_count: nodes.len(),
            dofs: [0; 9],
            count: 0,
            slots: [0; 3],
            body: [None; 3],
            body_dofs: [0; 3],
            moves: [false; 3],
            entries: [0; 45],
        };
        for (k, &node) in nodes.iter().enumerate() {
            this.nodes[k] = node;
            let (first, size) = match coordinates.anchors[node] {
                Anchor::Free { dof } => (dof, 2),
                Anchor::Rigid { body, .. } => {
                    this.body[k] = Some(body);
                    this.body_dofs[k] = coordinates.bodies[body];
                    (coordinates.bodies[body], 3)
                }
                Anchor::Fixed => continue,
            };
            this.moves[k] = true;
            this.slots[k] = this.slot_of(first, size);
        }
        this
    }

    /// The stencil of a magnet itself.
    pub fn of_body(coordinates: &Coordinates, body: usize) -> Self {
        let mut this = Self::new(coordinates, &[]);
        this.slot_of(coordinates.bodies[body], 3);
        this
    }

    /// Looks the places of its entries up, once the shape of the matrix is known.
    pub fn locate(&mut self, band: &Band) {
        let mut place = 0;
        for row in 0..self.count {
            for column in 0..=row {
                self.entries[place] = band.at(self.dofs[row], self.dofs[column]);
                place += 1;
            }
        }
    }

    fn slot_of(&mut self, first: usize, size: usize) -> usize {
        if let Some(slot) = self.dofs[..self.count].iter().position(|&d| d == first) {
            return slot;
        }
        let slot = self.count;
        for k in 0..size {
            self.dofs[slot + k] = first + k;
        }
        self.count += size;
        slot
    }
}
