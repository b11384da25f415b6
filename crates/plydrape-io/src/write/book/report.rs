//! The page of a book: a table of its plies, and where they lie.

use super::{PlyRecord, drawing};
use crate::PROGRAM;
use crate::scene::Book;
use crate::store::shown;

/// The look of the page, in light and dark.
const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1b1f24;--faint:#6a737d;--line:#d0d7de;--back:#fff;--good:#1a7f37;--bad:#cf222e}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--faint:#8b949e;--line:#30363d;--back:#0d1117;--good:#3fb950;--bad:#f85149}}
body{font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--back);max-width:68rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse;width:100%;margin:1rem 0}th,td{text-align:left;padding:.35rem .6rem;border-bottom:1px solid var(--line)}
th{color:var(--faint);font-weight:600}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}a{color:inherit}
.good{color:var(--good);font-weight:600}.bad{color:var(--bad);font-weight:600}.faint{color:var(--faint)}
svg.all{width:100%;max-width:40rem;border:1px solid var(--line)}svg.one{width:100%;border:1px solid var(--line)}
.plies{display:grid;grid-template-columns:repeat(auto-fill,minmax(15rem,1fr));gap:1rem}figure{margin:0}figcaption{font-size:.9em}
.mold{fill:var(--ink);stroke:none}.ply{fill:currentColor;fill-opacity:.06;fill-rule:evenodd;stroke:currentColor;stroke-width:2}
.below{fill:none;stroke:var(--faint);stroke-width:1;stroke-dasharray:5 4}.yarn{fill:none;stroke:currentColor;stroke-width:1.2;opacity:.7}
.warp{fill:none;stroke:currentColor;stroke-width:4}.mark{fill:var(--back);stroke:currentColor;stroke-width:2}
.number{font-size:13px;text-anchor:middle;dominant-baseline:central;fill:var(--ink)}
.c0{color:#0969da}.c1{color:#bf5700}.c2{color:#1a7f37}.c3{color:#8250df}.c4{color:#bf3989}.c5{color:#7d5e00}
@media(prefers-color-scheme:dark){.c0{color:#58a6ff}.c1{color:#f0883e}.c2{color:#3fb950}.c3{color:#a371f7}.c4{color:#f778ba}.c5{color:#d29922}}
@media print{body{margin:0}}";

/// `report.html` of a book: a page for any browser, without a network. Same plans, same bytes.
#[must_use]
pub fn html(book: &Book, plies: &[PlyRecord], interrupted: bool) -> String {
    let title = text(&book.title);
    let accepted = plies.iter().filter(|ply| ply.accepted).count();
    let (class, verdict) = match (accepted == plies.len(), interrupted) {
        (_, true) => {
            ("bad", format!("interrupted: {accepted} of {} plies accepted so far", plies.len()))
        }
        (true, _) => ("good", format!("all {} plies accepted", plies.len())),
        (false, _) => ("bad", format!("{accepted} of {} plies accepted", plies.len())),
    };
    let rows: String = plies.iter().enumerate().map(|(n, ply)| row(n, ply)).collect();
    let figures: String = plies.iter().enumerate().map(|(n, ply)| figure(book, n, ply)).collect();
    let motion: f64 = plies.iter().map(|ply| ply.motion_s).sum();
    let all = drawing::all(book, plies);
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
<title>{title}</title><style>\n{STYLE}\n</style></head><body>\n<h1>{title}</h1>\n<p class=\"{class}\">{verdict}</p>\n\
<table><thead><tr><th class=\"n\">order</th><th>ply</th><th>lies on</th><th class=\"n\">thickness mm</th><th>verdict</th><th>worst limit</th><th class=\"n\">motion s</th><th class=\"n\">drapes</th></tr></thead>\n\
<tbody>\n{rows}</tbody></table>\n<p class=\"faint\">All motions together take {motion:.1} s. A ply's name leads to its own page. The worst limit is the one that is \
exceeded most; of an accepted plan, the one nearest to not holding.</p>\n<h2>The plies on the mold, seen from above</h2>\n\
<p class=\"faint\">x to the right, y upwards. Each number is in the middle of its ply, on a line along the warp there.</p>\n{all}\
<h2>Ply by ply</h2>\n<p class=\"faint\">Lines of warp of the ideal drape; dashed, the plies beneath.</p>\n<div class=\"plies\">\n{figures}</div>\n\
<p class=\"faint\">{}</p>\n</body></html>\n",
        text(PROGRAM)
    )
}

fn row(n: usize, ply: &PlyRecord) -> String {
    let (class, verdict) = match ply.accepted {
        true => ("good", format!("accepted{}", ply.world.words())),
        false => ("bad", "not accepted".into()),
    };
    format!(
        "<tr><td class=\"n\">{}</td><td><a href=\"{}/report.html\">{}</a></td><td>{}</td><td class=\"n\">{}</td><td class=\"{class}\">{verdict}</td><td>{}</td><td class=\"n\">{:.1}</td><td class=\"n\">{}</td></tr>\n",
        n + 1,
        ply.folder,
        text(&ply.name),
        text(&ply.lies_on_text()),
        ply.thickness.map_or_else(|| "–".into(), shown::millimeters),
        text(&ply.worst_text()),
        ply.motion_s,
        ply.evaluations,
    )
}

fn figure(book: &Book, n: usize, ply: &PlyRecord) -> String {
    let heading = match ply.warp_heading {
        // a line has no sense: from 0° up to 180°, and no −0°
        Some(heading) => {
            format!(", warp at {:.0}°", heading.to_degrees().round().rem_euclid(180.0) + 0.0)
        }
        None => String::new(),
    };
    format!(
        "<figure>{}<figcaption>{}: {}{heading}</figcaption></figure>\n",
        drawing::ply(book, n),
        n + 1,
        text(&ply.name)
    )
}

/// A text that cannot leave its place in the page.
fn text(plain: &str) -> String {
    plain.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
