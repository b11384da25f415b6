//! Colors of a terminal.

/// Whether a text has the colors of a terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// None: for files, pipes and those who want none.
    Plain,
    /// Green, yellow and red, as every terminal knows them.
    Colored,
}

/// What a color says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tone {
    /// As it should be.
    Good,
    /// Close to its limit.
    Close,
    /// Beyond its limit.
    Bad,
    /// Of less weight.
    Faint,
}

impl Ink {
    /// A text in a tone.
    pub(super) fn tinted(self, text: &str, tone: Tone) -> String {
        let code = match tone {
            Tone::Good => 32,
            Tone::Close => 33,
            Tone::Bad => 31,
            Tone::Faint => 2,
        };
        match self {
            Ink::Plain => text.to_owned(),
            Ink::Colored => format!("\x1b[{code}m{text}\x1b[0m"),
        }
    }

    /// The lines of a text, each in the tone that a function gives its number.
    pub(super) fn lines(self, text: &str, tone: impl Fn(usize) -> Option<Tone>) -> String {
        let line = |(n, line): (usize, &str)| match tone(n) {
            Some(tone) => self.tinted(line, tone) + "\n",
            None => format!("{line}\n"),
        };
        text.lines().enumerate().map(line).collect()
    }
}
