#include "lift_slam/visualization/report_style.h"

namespace lift_slam {

namespace {

constexpr char kStyleSheet[] = R"css(
:root{color-scheme:light dark;--page:#fff;--panel:#f6f7f9;--rule:#e0e4e9;--text:#1d2127;--soft:#5b6571;
--ok:#00734f;--ok-bg:#e2f4ed;--mid:#8a5a00;--mid-bg:#fdf1d8;--bad:#a93c00;--bad-bg:#fdeadf;--bar:#0072b2}
@media screen and (prefers-color-scheme:dark){:root{--page:#13161b;--panel:#1a1e24;--rule:#2b3139;--text:#e6eaef;
--soft:#9aa5b1;--ok:#5fd6ae;--ok-bg:#12332a;--mid:#f5c260;--mid-bg:#3a2c10;--bad:#ff9a66;--bad-bg:#3e2013;--bar:#4aa8e8}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1200px;padding:32px 24px 64px;background:var(--page);color:var(--text);
font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
h1{font-size:26px;line-height:1.25;margin:0;letter-spacing:-.01em;overflow-wrap:anywhere}
h2{font-size:19px;margin:44px 0 14px;padding-top:18px;border-top:1px solid var(--rule);letter-spacing:-.005em}
.kicker{margin:0 0 2px;color:var(--soft);font-size:13px;letter-spacing:.02em}
.status{display:flex;gap:18px;align-items:flex-start;margin:20px 0 24px;padding:16px 20px;border-radius:10px}
.status b{flex:none;font-size:15px;line-height:24px;letter-spacing:.03em;white-space:nowrap}
.status b::before{margin-right:8px}
.status p{margin:0}.status p+p{margin-top:4px}
.s-ok{background:var(--ok-bg)}.s-ok b{color:var(--ok)}.s-ok b::before{content:"\2713"}
.s-mid{background:var(--mid-bg)}.s-mid b{color:var(--mid)}.s-mid b::before{content:"!"}
.s-bad{background:var(--bad-bg)}.s-bad b{color:var(--bad)}.s-bad b::before{content:"\2715"}
.key{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));margin:0;
border:1px solid var(--rule);border-radius:10px;overflow:hidden}
.key div{padding:12px 16px;box-shadow:1px 0 0 var(--rule),0 1px 0 var(--rule)}
.key dt{color:var(--soft);font-size:13px}.key dd{margin:0;font-size:23px;line-height:1.3;font-weight:600;font-variant-numeric:tabular-nums;white-space:nowrap}
.key p{margin:2px 0 0;color:var(--soft);font-size:12px;line-height:1.35}
.unit{font-weight:400;font-size:.72em;color:var(--soft)}
td .unit{font-size:1em}
.pair{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:24px}
.stack{display:flex;flex-direction:column;gap:20px}
figure{margin:0;min-width:0}
figcaption,.cap{font-size:14px;font-weight:600;margin:0 0 8px}
.note{color:var(--soft);font-size:13px}p.note{margin:6px 0 0}
.scroll{overflow-x:auto}
.wide+.wide{margin-top:24px}
.notice{background:var(--panel);border-radius:10px;padding:28px 28px;margin:0}
.notice strong{display:block;font-size:21px;line-height:1.35;font-weight:600;margin-bottom:10px}
.notice ul{margin:0;padding:0;list-style:none}.notice li{display:grid;grid-template-columns:180px 1fr;padding:3px 0}
.viewer{position:relative;border-radius:8px;overflow:hidden;background:#13161b;border:1px solid var(--rule)}
.viewer canvas{display:block;width:100%;aspect-ratio:560/446;cursor:grab;touch-action:none}
.viewer canvas:active{cursor:grabbing}.viewer canvas:focus-visible{outline:2px solid var(--bar);outline-offset:-2px}
.viewer select{position:absolute;top:10px;right:10px}
.viewer-key{position:absolute;left:12px;bottom:8px;margin:0;padding:2px 8px;border-radius:5px;background:#13161bd9;font-size:12px;color:#c6ced8;pointer-events:none}
.viewer-key i{display:inline-block;width:14px;height:3px;margin:0 5px 3px 8px;border-radius:2px;background:#4aa8e8}
.viewer-key .k1{margin-left:0}.viewer-key .k2{background:#f3a63a}.viewer-key .k3{background:#e8edf3}
.frames{display:grid;grid-template-columns:repeat(auto-fill,minmax(340px,1fr));gap:22px 20px}.wide-frames{grid-template-columns:repeat(auto-fill,minmax(440px,1fr))}
.frames img{display:block;width:100%;height:auto;border-radius:6px;background:var(--panel)}
.frames figcaption{font-weight:400;font-size:13px;margin:6px 0 0;color:var(--soft)}
.frames figcaption b{color:var(--text);font-weight:600}
.dot{display:inline-block;width:9px;height:9px;border-radius:50%;margin:0 4px 0 10px;border:2px solid #18b98a}
.dot.u{width:6px;height:6px;border:0;background:#e69f00;vertical-align:1px}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
caption{text-align:left;font-weight:600;padding:0 0 6px}
th,td{padding:5px 14px 5px 0;text-align:left;vertical-align:top;border-top:1px solid var(--rule);font-weight:400}
table.narrow{width:auto;min-width:440px}details th{width:200px}
thead th{color:var(--soft);font-size:13px;border-top:0;padding-top:0}
.num{text-align:right;white-space:nowrap}.val{overflow-wrap:anywhere}
td.share{width:120px;padding-top:11px}.share i{display:block;height:8px;border-radius:2px;background:var(--bar);min-width:1px}
.columns{columns:2;column-gap:40px}.columns th{width:36%}.columns .val{white-space:nowrap}.columns table,.columns .scroll{break-inside:avoid;margin:0 0 26px}
.scroll+.scroll{margin-top:28px}
details{border-top:1px solid var(--rule);padding:10px 0}details:last-of-type{border-bottom:1px solid var(--rule)}
summary{cursor:pointer;font-weight:600}details>*:not(summary){margin-top:10px}
pre{margin:10px 0 0;padding:14px 16px;background:var(--panel);border-radius:8px;overflow-x:auto;
font:12.5px/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace}
@media (max-width:820px){.pair{grid-template-columns:minmax(0,1fr)}.columns{columns:1}.wide .plot{min-width:720px}
body{padding:20px 14px 40px}.status{flex-direction:column;gap:6px}}
@media print{body{padding:0;max-width:none;font-size:12px}h2{break-after:avoid;margin-top:24px}figure,.key,.status,table{break-inside:avoid}
.status,.key,.viewer,.share i{-webkit-print-color-adjust:exact;print-color-adjust:exact}.frames,.wide-frames{grid-template-columns:repeat(2,1fr)}}
)css";

}  // namespace

const char* ReportStyleSheet() { return kStyleSheet; }

}  // namespace lift_slam
