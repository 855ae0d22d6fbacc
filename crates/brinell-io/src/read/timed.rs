//! The column of times that belongs to a channel.

use super::channel::Channel;
use super::stated::DIFFERS;
use super::{FileKind, SignalFile};
use std::cmp::Reverse;

/// Why none of the columns of times is taken for a channel, in words that a request for the rate goes on from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoTimes {
    /// None is as long as the channel.
    Unlike(String),
    /// Which of several is not clear, and they give different rates.
    Several(String),
}

impl std::fmt::Display for NoTimes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (Self::Unlike(words) | Self::Several(words)) = self;
        f.write_str(words)
    }
}

impl Channel {
    /// Whether so many times may be those of its samples: as many as it has, or as a side of a matrix; of a text file all
    /// are.
    pub fn is_timed_by(&self, times: &Channel) -> bool {
        match (times.length, self.length) {
            // One more at the end: 0:1/fs:T.
            (Some(times), Some(own)) => times == own || times == own + 1 || self.shape.contains(&times),
            _ => true,
        }
    }

    /// That they are not, in words.
    pub fn not_timed_by(&self, times: &Channel) -> String {
        let count = |c: &Channel| c.length.unwrap_or_default();
        format!("`{}` has {} times and `{}` {} values", times.name, count(times), self.name, count(self))
    }
}

impl SignalFile {
    /// The column of times of a channel. It is as long as the channel; in its group, else in one around it or one
    /// without signals; called like one, else in a unit of time and evenly spaced; in a table the nearest to its left.
    ///
    /// # Errors
    /// Where none fits, or where several do and give different rates.
    pub fn times_of(&mut self, of: &Channel) -> Result<Option<Channel>, NoTimes> {
        let channels = self.channels();
        let all: Vec<usize> = (0..channels.len())
            .filter(|&i| {
                let c = &channels[i];
                c.is_time() && c.may_be_signal() && !c.is_matrix() && c.name != of.name && self.is_about(c, of)
            })
            .collect();
        let called = |i: &&usize| channels[**i].is_called_time();
        let fit: Vec<usize> = all.iter().copied().filter(|&i| of.is_timed_by(&channels[i])).collect();
        if fit.is_empty() {
            let unlike = all.iter().find(called).map(|&i| of.not_timed_by(&channels[i]));
            return unlike.map_or(Ok(None), |words| Err(NoTimes::Unlike(words)));
        }
        let nearest = fit.iter().map(|&i| self.nearness(&channels[i], of)).max();
        let near: Vec<usize> = fit.into_iter().filter(|&i| Some(self.nearness(&channels[i], of)) == nearest).collect();
        let called: Vec<usize> = near.iter().filter(called).copied().collect();
        let (these, are_called) = if called.is_empty() { (near, false) } else { (called, true) };
        // Of several, or of what has but a unit of time, those that give a rate: T may be a temperature.
        let mut even = these.clone();
        if these.len() > 1 || !are_called {
            even.retain(|&i| {
                let name = self.channels()[i].name.clone();
                self.rate_of(&name, 1.0).is_ok_and(|rate| rate.is_ok())
            });
        }
        let these = match (even.is_empty(), are_called) {
            (false, _) => even,
            (true, true) => these,
            (true, false) => return Ok(None),
        };
        let open = self.contenders(&these, of);
        self.agreed(&open).map(Some)
    }

    /// The groups that a channel lies in.
    fn groups<'a>(&self, channel: &'a Channel) -> Vec<&'a str> {
        if !matches!(self.kind(), FileKind::Mat5 | FileKind::Hdf5 | FileKind::Npz | FileKind::Tdms) {
            return Vec::new();
        }
        let mut parts: Vec<&str> = channel.name.split(['.', '/']).collect();
        parts.pop();
        parts
    }

    /// Whether times may belong to a channel: they lie in its group or around it, or where no signal is.
    fn is_about(&self, times: &Channel, of: &Channel) -> bool {
        let group = self.groups(times);
        let signal = |c: &&Channel| c.may_be_signal() && !c.is_time() && self.groups(c) == group;
        self.groups(of).starts_with(&group) || !self.channels().iter().any(|c| signal(&c))
    }

    /// More for times that share more groups with a channel, and then for those in fewer others.
    fn nearness(&self, times: &Channel, of: &Channel) -> (usize, Reverse<usize>) {
        let (group, own) = (self.groups(times), self.groups(of));
        let shared = group.iter().zip(&own).take_while(|(a, b)| a == b).count();
        (shared, Reverse(group.len() - shared))
    }

    /// Which of several columns of times it may be, the likeliest first. In a table that begins with times it is the
    /// nearest to the channel's left, with those that stand beside it.
    fn contenders(&self, times: &[usize], of: &Channel) -> Vec<usize> {
        let channels = self.channels();
        let is_table = matches!(self.kind(), FileKind::Text | FileKind::Parquet);
        let at = channels.iter().position(|c| c.name == of.name).unwrap_or(0);
        let left: Vec<usize> = times.iter().copied().filter(|&i| i < at).rev().collect();
        let first = channels.iter().position(Channel::may_be_signal);
        if !is_table || left.is_empty() || first != times.first().copied() {
            return left.iter().copied().chain(times.iter().copied().filter(|&i| i >= at)).collect();
        }
        let beside = left.windows(2).take_while(|w| w[0] == w[1] + 1).count();
        left[..=beside].to_vec()
    }

    /// The first that gives a rate, where no other gives another.
    fn agreed(&mut self, times: &[usize]) -> Result<Channel, NoTimes> {
        let channel = |file: &Self, i: usize| file.channels()[i].clone();
        let first = channel(self, times[0]);
        if times.len() == 1 {
            return Ok(first);
        }
        let mut rates = Vec::new();
        for &i in times {
            let time = channel(self, i);
            if let Some(unit) = time.seconds_in_time_unit() {
                let hz = self.rate_of(&time.name, unit).ok().and_then(Result::ok);
                rates.push((time, hz));
            }
        }
        let Some((best, hz)) = rates.iter().find_map(|(time, hz)| Some((time, (*hz)?))) else {
            return Ok(first);
        };
        let other = rates.iter().find(|(_, other)| other.is_none_or(|other| (other / hz - 1.0).abs() > DIFFERS));
        match other {
            None => Ok(best.clone()),
            Some((other, rate)) => Err(NoTimes::Several(format!(
                "which times belong to the channel is not clear: those in `{}` say {hz} Hz, and those in `{}` {}",
                best.name,
                other.name,
                rate.map_or("give no rate".into(), |rate| format!("{rate} Hz"))
            ))),
        }
    }
}
