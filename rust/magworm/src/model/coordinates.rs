//! Unknowns of the equations of motion and how the nodes hang on them.
//!
//! *Reduced*: a free node has its position; a rigid magnet has position and rotation and carries its two
//! end nodes. *With multipliers* (the paper): every node has its position, each magnet position and
//! rotation, and each end of a magnet Lagrange multipliers that tie the node to it. Unknowns are numbered
//! along the body, so that every matrix is banded.
//!
//! | | node | magnet | soft element | tie |
//! |---|---|---|---|---|
//! | plane | x, y | x, y, θ | | 2 |
//! | space | x, y, z | x, y, z, rotation about x, y, z | twist about its tangent | 3 |

use super::Mesh;
use crate::lanes::Dimensions;
use crate::lanes::chain::Chain;

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
    /// Its x is unknown `dof`, its y the next, then z in space.
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

/// A node tied to a magnet by a multiplier for each direction.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    /// First multiplier (x); y is the next, then z in space.
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
    /// 2 in the plane, 3 in space.
    pub dimensions: usize,
    /// Number of unknowns.
    pub count: usize,
    /// For each node.
    pub anchors: Vec<Anchor>,
    /// First unknown of each magnet: its position, then its rotation.
    pub bodies: Vec<usize>,
    /// In space the twist of each soft element that is not clamped.
    pub twists: Vec<Option<usize>>,
    /// The magnet that makes an element rigid.
    pub rigid: Vec<Option<usize>>,
    /// Multipliers; none in reduced coordinates.
    pub ties: Vec<Tie>,
}

impl Coordinates {
    /// Numbers the unknowns of a mesh in the plane (2) or in space (3).
    pub fn new(mesh: &Mesh, unknowns: Unknowns, dimensions: usize) -> Self {
        let nodes = mesh.arc_m.len();
        let mut this = Self {
            dimensions,
            count: 0,
            anchors: Vec::new(),
            bodies: Vec::new(),
            twists: Vec::new(),
            rigid: mesh.elements.iter().map(|element| element.body).collect(),
            ties: Vec::new(),
        };
        let ends = magnet_ends(mesh);
        for node in 0..nodes {
            match ends[node] {
                Some((body, side)) => this.number_magnet_end(node, body, side, unknowns),
                None if node < mesh.fixed_nodes => this.anchors.push(Anchor::Fixed),
                None => this.number_free(),
            }
            if node < mesh.elements.len() {
                this.number_twist(mesh, node);
            }
        }
        this
    }

    /// Sizes that follow from the dimension.
    pub fn sizes(&self) -> Dimensions {
        Dimensions::new(self.dimensions)
    }

    /// Unknowns of a magnet.
    pub fn body_size(&self) -> usize {
        self.sizes().body()
    }

    fn number_free(&mut self) {
        let dof = self.take(self.dimensions);
        self.anchors.push(Anchor::Free { dof });
    }

    fn number_twist(&mut self, mesh: &Mesh, element: usize) {
        let clamped = element + 1 < mesh.fixed_nodes;
        let twists = mesh.elements[element].body.is_none() && !clamped;
        let twists = twists && self.sizes().twists() > 0;
        let dof = twists.then(|| self.take(1));
        self.twists.push(dof);
    }

    fn number_magnet_end(&mut self, node: usize, body: usize, side: i8, unknowns: Unknowns) {
        let head = side < 0;
        match unknowns {
            Unknowns::Reduced => {
                if head {
                    let dof = self.take(self.body_size());
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
                let dof = self.take(self.dimensions);
                self.ties.push(Tie { dof, node, body, side });
                if head {
                    let dof = self.take(self.body_size());
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
    for (body, rigid) in mesh.bodies.iter().enumerate() {
        ends[rigid.element] = Some((body, -1));
        ends[rigid.element + 1] = Some((body, 1));
    }
    ends
}

/// Most unknowns in one stencil: two magnets and a node between them, with the twist of two elements.
pub const MAX_STENCIL: usize = 17;

/// What the twist of an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spin {
    /// Nothing: the element is clamped, or the motion is in the plane.
    Fixed,
    /// An unknown of its own, at this place of the stencil.
    Free(usize),
    /// The part along the tangent of its magnet's rotation, whose first unknown is at this place.
    Rigid(usize),
}

/// The unknowns that up to three nodes and the elements between them hang on, in ascending order, and
/// where each one's part is.
#[derive(Clone, Copy, Debug)]
pub struct Stencil {
    /// The nodes.
    pub nodes: [usize; 3],
    /// How many of them are used.
    pub node_count: usize,
    /// The unknowns.
    pub dofs: [usize; MAX_STENCIL],
    /// How many of them are used.
    pub count: usize,
    /// Place in `dofs` of each node's x; the other directions follow, then its magnet's rotation.
    pub slots: [usize; 3],
    /// The magnet each node is rigidly on.
    pub body: [Option<usize>; 3],
    /// First unknown of that magnet.
    pub body_dofs: [usize; 3],
    /// Whether each node can move.
    pub moves: [bool; 3],
    /// Twist of the elements between the nodes.
    pub spins: [Spin; 2],
    /// Places in the matrix of all pairs of unknowns, lower triangle by rows.
    pub entries: [usize; MAX_STENCIL * (MAX_STENCIL + 1) / 2],
}

impl Stencil {
    /// The stencil of the positions of `nodes`, which must be consecutive along the body.
    pub fn new(coordinates: &Coordinates, nodes: &[usize]) -> Self {
        Self::along(coordinates, nodes, false)
    }

    /// The stencil of `nodes` and of the twist of the elements between them.
    pub fn with_twist(coordinates: &Coordinates, nodes: &[usize]) -> Self {
        Self::along(coordinates, nodes, coordinates.sizes().twists() > 0)
    }

    fn along(coordinates: &Coordinates, nodes: &[usize], twist: bool) -> Self {
        let mut this = Self {
            nodes: [0; 3],
            node_count: nodes.len(),
            dofs: [0; MAX_STENCIL],
            count: 0,
            slots: [0; 3],
            body: [None; 3],
            body_dofs: [0; 3],
            moves: [false; 3],
            spins: [Spin::Fixed; 2],
            entries: [0; MAX_STENCIL * (MAX_STENCIL + 1) / 2],
        };
        for (k, &node) in nodes.iter().enumerate() {
            this.add_node(coordinates, k, node);
            if twist && k + 1 < nodes.len() {
                this.add_spin(coordinates, k, node);
            }
        }
        this
    }

    fn add_node(&mut self, coordinates: &Coordinates, k: usize, node: usize) {
        self.nodes[k] = node;
        let (first, size) = match coordinates.anchors[node] {
            Anchor::Free { dof } => (dof, coordinates.dimensions),
            Anchor::Rigid { body, .. } => {
                self.body[k] = Some(body);
                self.body_dofs[k] = coordinates.bodies[body];
                (coordinates.bodies[body], coordinates.body_size())
            }
            Anchor::Fixed => return,
        };
        self.moves[k] = true;
        self.slots[k] = self.slot_of(first, size);
    }

    /// Twist of the element that starts at `node`.
    fn add_spin(&mut self, coordinates: &Coordinates, k: usize, node: usize) {
        self.spins[k] = match coordinates.twists[node] {
            Some(dof) => Spin::Free(self.slot_of(dof, 1)),
            None => match coordinates.rigid[node] {
                Some(body) => {
                    let first = coordinates.bodies[body];
                    Spin::Rigid(self.slot_of(first, coordinates.body_size()) + 3)
                }
                None => Spin::Fixed,
            },
        };
    }

    /// The unknowns that are used.
    pub fn unknowns(&self) -> &[usize] {
        &self.dofs[..self.count]
    }

    /// Looks the places of its entries up, once the shape of the matrix is known.
    pub fn locate(&mut self, system: &Chain) {
        let mut place = 0;
        for row in 0..self.count {
            for column in 0..=row {
                self.entries[place] = system.at(self.dofs[row], self.dofs[column]);
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
