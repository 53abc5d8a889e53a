//! Ranks that are threads of one process, for tests.

use super::Ranks;
use crate::error::Result;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};

/// One of them. Where another one panics, it does too, as nothing comes any more.
#[derive(Debug)]
pub(crate) struct ThreadRank {
    rank: usize,
    to: Vec<Sender<Vec<f64>>>,
    from: Vec<Mutex<Receiver<Vec<f64>>>>,
}

/// Runs `work` on so many ranks, and gives what each has found.
pub(crate) fn on_ranks<T: Send>(count: usize, work: impl Fn(Arc<dyn Ranks>) -> T + Sync) -> Vec<T> {
    let mut to: Vec<Vec<_>> = (0..count).map(|_| Vec::new()).collect();
    let mut from: Vec<Vec<_>> = (0..count).map(|_| Vec::new()).collect();
    for senders in &mut to {
        for receivers in &mut from {
            let (sender, receiver) = channel();
            senders.push(sender);
            receivers.push(Mutex::new(receiver));
        }
    }
    let work = &work;
    std::thread::scope(|scope| {
        let ranks = to.into_iter().zip(from).enumerate();
        let ranks = ranks.map(|(rank, (to, from))| {
            scope.spawn(move || work(Arc::new(ThreadRank { rank, to, from })))
        });
        let ranks: Vec<_> = ranks.collect();
        ranks.into_iter().map(|rank| rank.join().unwrap()).collect()
    })
}

impl Ranks for ThreadRank {
    fn rank(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.to.len()
    }

    fn exchange(
        &self,
        send: &[f64],
        send_counts: &[usize],
        receive: &mut [f64],
        receive_counts: &[usize],
    ) -> Result<()> {
        let mut rest = send;
        for (to, &count) in self.to.iter().zip(send_counts) {
            let (part, next) = rest.split_at(count);
            to.send(part.to_vec()).unwrap();
            rest = next;
        }
        let mut rest = receive;
        for (from, &count) in self.from.iter().zip(receive_counts) {
            let (part, next) = std::mem::take(&mut rest).split_at_mut(count);
            part.copy_from_slice(&from.lock().unwrap().recv().unwrap());
            rest = next;
        }
        Ok(())
    }

    fn gather(&self, send: &[f64], receive: &mut [f64], receive_counts: &[usize]) -> Result<()> {
        let all = send.repeat(self.count());
        let counts = vec![send.len(); self.count()];
        self.exchange(&all, &counts, receive, receive_counts)
    }
}
