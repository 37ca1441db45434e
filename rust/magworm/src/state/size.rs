//! What a block takes in memory. A new field does not compile before it is counted here.

use super::block::Block;
use super::rows::Rows;
use crate::contact::Workspace;
use crate::lanes::Row;

/// What an allocator adds to each list of rows, at most [bytes].
const OVERHEAD: usize = 64 + 32;

impl<R: Row> Block<R> {
    /// What it takes, with the state that is kept before a call that may be stopped [bytes].
    pub fn bytes(&self) -> usize {
        let Self {
            // The state.
            q: _,
            v: _,
            lagged: _,
            normal: _,
            pad: _,
            mode: _,
            stage: _,
            target: _,
            action: _,
            step_count: _,
            factors: _,
            present: _,
            held: _,
            director: _,
            twist: _,
            wrench: _,
            status,
            // The workspace.
            mass,
            off_centre,
            remanence,
            running,
            node,
            tangent,
            length,
            inverse_length,
            side,
            frame,
            matrix,
            right,
            next,
            robot_before,
            contact,
            counters: _,
            set: _,
            kept: _,
        } = self;
        let rows = [
            mass,
            off_centre,
            remanence,
            running,
            node,
            tangent,
            length,
            inverse_length,
            side,
            frame,
            matrix,
            right,
            next,
        ];
        let of_lanes = 2 * size_of_val(&**status) + size_of_val(&**robot_before);
        size_of::<Self>()
            + 2 * sum(self.state_rows())
            + sum(rows)
            + of_workspace(contact)
            + of_lanes
    }
}

fn of_workspace<R: Row>(workspace: &Workspace<R>) -> usize {
    let Workspace {
        arm,
        bias,
        coefficient,
        warm,
        bound,
        response,
        touching,
        slip,
        velocity,
        velocity_change,
        matrix,
        target,
        known,
        direction,
        imbalance,
        imbalance_change,
        residual,
        mobility,
        search,
    } = workspace;
    sum([
        arm,
        bias,
        coefficient,
        warm,
        bound,
        response,
        touching,
        slip,
        velocity,
        velocity_change,
        matrix,
        target,
        known,
        direction,
        imbalance,
        imbalance_change,
        residual,
        mobility,
        search,
    ])
}

fn sum<R: Row, const K: usize>(lists: [&Rows<R>; K]) -> usize {
    lists.iter().map(|rows| size_of_val(&rows[..]) + OVERHEAD).sum()
}
