// browser.mjs RUNS [PICTURES]   opens the pages in the folders of RUNS in a browser without network
// and does what a person would. Pictures go where they are wanted. Every kind of page has its file.
import './live_page.mjs';
import './run_page.mjs';
import './plots_page.mjs';
import './run_list_page.mjs';
import './units_page.mjs';
import './stand_page.mjs';
import './compare_page.mjs';
import './gallery_page.mjs';
import './fit_page.mjs';
import './study_page.mjs';
import './references.mjs';
